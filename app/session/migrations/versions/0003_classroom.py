"""A class at work: its lessons, exercises made here, hints, what everybody does."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """All of it."""
    op.create_table(
        "lessons",
        sa.Column("id", sa.String(32), primary_key=True),
        sa.Column("class", sa.String(32), nullable=False),
        sa.Column("exercise", sa.String(80), nullable=False),
        sa.Column("place", sa.Integer, nullable=False),
        sa.Column("due", sa.Float, nullable=False),
        sa.Column("without", sa.String(120), nullable=False),
    )
    op.create_index("ix_lessons_class", "lessons", ["class"])
    op.create_table(
        "class_helps",
        sa.Column("class", sa.String(32), primary_key=True),
        sa.Column("without", sa.String(120), nullable=False),
    )
    op.create_table(
        "made_exercises",
        sa.Column("key", sa.String(80), primary_key=True),
        sa.Column("author", sa.String(32), primary_key=True),
        sa.Column("created", sa.Float, nullable=False),
        sa.Column("hidden", sa.Boolean, nullable=False),
        sa.Column("lesson", sa.Text, nullable=False),
    )
    op.create_table(
        "hints",
        sa.Column("id", sa.Integer, primary_key=True, autoincrement=True),
        sa.Column("trainer", sa.String(32), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("sent", sa.Float, nullable=False),
        sa.Column("shown", sa.Float, nullable=False),
        sa.Column("put_away", sa.Float, nullable=False),
    )
    op.create_index("ix_hints_owner", "hints", ["owner"])
    op.create_table(
        "presence",
        sa.Column("owner", sa.String(64), primary_key=True),
        sa.Column("session", sa.String(32), nullable=False),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("since", sa.Float, nullable=False),
        sa.Column("at", sa.Float, nullable=False),
        sa.Column("exercise", sa.String(80), nullable=False),
        sa.Column("done", sa.Integer, nullable=False),
        sa.Column("points", sa.Integer, nullable=False),
    )

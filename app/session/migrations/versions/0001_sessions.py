"""Sessions, their actions, whose they are, and scores: what version 0.1.0 had, which made each when it was needed."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """All of it where it is missing; what is there stays as it is."""
    there: dict[str, Any] = {"if_not_exists": True}
    op.create_table(
        "sessions",
        sa.Column("name", sa.String(32), primary_key=True),
        sa.Column("created", sa.Float, nullable=False),
        **there,
    )
    op.create_table(
        "actions",
        sa.Column("session", sa.String(32), primary_key=True),
        sa.Column("n", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("t", sa.Float, nullable=False),
        sa.Column("action", sa.Text, nullable=False),
        sqlite_with_rowid=False,
        **there,
    )
    op.create_table(
        "owned",
        sa.Column("session", sa.String(32), primary_key=True),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("title", sa.String(120), nullable=False),
        sa.Column("opened", sa.Float, nullable=False),
        **there,
    )
    op.create_index("ix_owned_owner", "owned", ["owner"], **there)
    op.create_table(
        "scores",
        sa.Column("id", sa.Integer, primary_key=True, autoincrement=True),
        sa.Column("trainee", sa.String(80), nullable=False),
        sa.Column("session", sa.String(32), nullable=False),
        sa.Column("exercise", sa.String(80), nullable=False),
        sa.Column("begun", sa.Float, nullable=False),
        sa.Column("total", sa.Float, nullable=False),
        sa.Column("card", sa.Text, nullable=False),
        **there,
    )
    op.create_index("ix_scores_trainee", "scores", ["trainee"], **there)

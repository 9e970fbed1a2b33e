"""Which process writes a session, and who waits for it."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """One table."""
    op.create_table(
        "leases",
        sa.Column("session", sa.String(32), primary_key=True),
        sa.Column("worker", sa.String(160), nullable=False),
        sa.Column("beat", sa.Integer, nullable=False),
        sa.Column("wanted", sa.String(160), nullable=False),
    )
    op.create_index("ix_leases_worker", "leases", ["worker"])

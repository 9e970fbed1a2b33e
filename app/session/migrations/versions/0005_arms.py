"""Arms that people bring by their own descriptions."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Two tables: the arms, and their descriptions in pieces."""
    op.create_table(
        "arms",
        sa.Column("owner", sa.String(64), primary_key=True),
        sa.Column("name", sa.String(64), primary_key=True),
        sa.Column("title", sa.String(120), nullable=False),
        sa.Column("chain", sa.Text, nullable=False),
        sa.Column("size", sa.Integer, nullable=False),
        sa.Column("brought", sa.Float, nullable=False),
    )
    op.create_table(
        "arm_pieces",
        sa.Column("owner", sa.String(64), primary_key=True),
        sa.Column("name", sa.String(64), primary_key=True),
        sa.Column("n", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("piece", sa.LargeBinary, nullable=False),
    )

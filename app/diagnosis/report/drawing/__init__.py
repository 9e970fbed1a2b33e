"""Pictures as plain SVG text: small, sharp on paper, without a library on the page."""

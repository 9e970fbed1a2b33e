"""Laws that no library holds."""

"""Whether two languages say the same: the fields of a sentence, in the form the English one gives them."""

import re

FIELD = re.compile(r"{(\w+)([^}]*)}")


def unlike(english, other):
    """Keys of the English texts that the other language lacks, or says with other fields."""
    return [k for k in english if k not in other or fields(english[k]) != fields(other[k])]


def fields(text):
    """Names and forms of a text's fields, in alphabetical order."""
    return sorted(FIELD.findall(text))

"""What a record is of: a function, a part of it, or a quantity of a kernel."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One line of a table: a function, or one part of a complex one."""

    function: str
    part: str
    function_class: str

    @property
    def label(self):
        """What people read: `sin`, `ctan re`."""
        return self.function if self.part == "value" else f"{self.function} {self.part}"

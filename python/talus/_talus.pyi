# The extension module is private, and the package's own classes are its typed face.
from typing import Any

version: str

def __getattr__(name: str) -> Any: ...

"""Points, meshes and direction fields, in and out of files (docs/formats.md)."""

from pdtheory.io.read import read_cloud
from pdtheory.io.write import read_field, write_cloud, write_field

__all__ = ["read_cloud", "read_field", "write_cloud", "write_field"]

"""From a derived model to Python source, and to the files in `generated/`."""

from rockeom.codegen.declaration import declaration_digest
from rockeom.codegen.module import module_text
from rockeom.codegen.write import check_generated, write_generated

__all__ = ["check_generated", "declaration_digest", "module_text", "write_generated"]

"""The shipped structures; each is declared in a file of this folder, and nowhere else.

To add one, put a file here with the function that declares it,

    from rockeom.symbolic.registry import shipped

    @shipped
    def my_structure() -> RockingModel:
        ...

and write its module with ``rockeom generate``. From there on it is ``rockeom.MyStructure``,
``rockeom simulate my_structure``, and part of every list, page and test of all structures.
"""

"""The wall as Housner's block about the edges of its base, made as the one about its centre."""

from rockeom.structures.shipped.declarations import simplified_substitute_gravity_wall as declared
from rockeom.structures.shipped.substitute_gravity_wall import SubstituteGravityWall


class SimplifiedSubstituteGravityWall(
    declared.SimplifiedSubstituteGravityWall, SubstituteGravityWall
):
    pass

"""Closed forms of the block without dimensions."""

from rockeom.structures.shipped.declarations import nondimensional_block as declared


class NondimensionalBlock(declared.NondimensionalBlock):
    sizes_checked = False  # a radius_ratio of no body is a hint: the equations hold all the same

    def hints(self) -> tuple[str, ...]:
        if 0.5 <= self.radius_ratio <= 1:
            return ()
        return (
            f"radius_ratio is {self.radius_ratio:.4g}; m R**2/I_o of a block lies between 1/2, all "
            "its mass at the corners, and 1, all of it at the centroid.",
        )

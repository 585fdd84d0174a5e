"""Sewing patterns made by hand."""


def pattern_of_a_tube():
    """Two panels of 30 x 20 cm that face each other, sewn along both sides."""
    def panel(z, corners):
        edges = [{"endpoints": [k, (k + 1) % 4]} for k in range(4)]
        return {"vertices": corners, "edges": edges, "translation": [-15, 100, z], "rotation": [0, 0, 0]}
    front = panel(12, [[0, 0], [30, 0], [30, 20], [0, 20]])
    back = panel(-12, [[0, 0], [0, 20], [30, 20], [30, 0]])
    stitches = [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}],
                [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 0}]]
    return {"pattern": {"panels": {"front": front, "back/left": back}, "stitches": [
        [{**end, "panel": end["panel"].replace("back", "back/left")} for end in stitch] for stitch in stitches]},
        "properties": {"units_in_meter": 100}}

"""What a FOLD file says about itself, from its numbers alone."""

import numpy as np


def defects(document):
    """Largest difference of edge lengths flat and folded, distance of diagonals of quads, and miss of angle sums."""
    flat, folded = (np.array(frame["vertices_coords"], float) for frame in (document, document["file_frames"][0]))
    edges = np.array(document["edges_vertices"])
    inner = np.ones(len(folded), bool)
    inner[edges[np.array(document["edges_assignment"]) == "B"]] = False
    lengths = [np.linalg.norm(np.diff(points[edges], axis=1)[:, 0], axis=-1) for points in (flat, folded)]
    faces = np.array(document["faces_vertices"])
    p, q, r, s = (folded[faces[:, k]] for k in range(4))
    normal = np.cross(r - p, s - q)
    apart = np.abs(np.einsum("ij,ij->i", q - p, normal)) / np.linalg.norm(normal, axis=1) / np.linalg.norm(r - p, axis=1)
    sums = np.zeros(len(folded))
    for k in range(4):
        corner, after, before = (folded[faces[:, (k + turn) % 4]] for turn in (0, 1, 3))
        a, b = after - corner, before - corner
        np.add.at(sums, faces[:, k], np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)))
    return np.abs(lengths[0] - lengths[1]).max(), apart.max(), np.abs(sums[inner] - 2 * np.pi).max()

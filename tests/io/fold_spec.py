"""What the FOLD 1.2 specification demands of a file, written down from its text and independently of the writer."""

ASSIGNMENTS = set("BMVFUCJ")
UNITS = {"unit", "in", "pt", "m", "cm", "mm", "um", "nm", "ft"}  # ft is custom, and allowed as such
FILE_CLASSES = {"singleModel", "multiModel", "animation", "diagrams"}
FRAME_CLASSES = {"creasePattern", "foldedForm", "graph", "linkage"}
ATTRIBUTES = {"2D", "3D", "abstract", "manifold", "nonManifold", "orientable", "nonOrientable", "selfTouching",
              "nonSelfTouching", "selfIntersecting", "nonSelfIntersecting", "cuts", "noCuts", "joins", "noJoins",
              "convexFaces", "nonConvexFaces"}
KNOWN = {
    "file": {"spec", "creator", "author", "title", "description", "classes", "frames"},
    "frame": {"author", "title", "description", "classes", "attributes", "unit", "parent", "inherit"},
    "vertices": {"coords", "vertices", "edges", "faces"},
    "edges": {"vertices", "faces", "assignment", "foldAngle", "length"},
    "faces": {"vertices", "edges", "faces"},
}


def violations(document):
    """Sentences about everything in the document that the specification does not allow; empty for a valid file."""
    out = []
    if not isinstance(document.get("file_spec"), int | float):
        out.append("file_spec is no number")
    _words(document, "file_classes", FILE_CLASSES, out)
    frames = [document, *document.get("file_frames", [])]
    for number, frame in enumerate(frames):
        if number and any(key.startswith("file_") for key in frame):
            out.append(f"frame {number} has file properties")
        resolved = _inherited(frames, number, out)
        out += [f"frame {number}: {sentence}" for sentence in _frame(resolved)]
    return out


def _inherited(frames, number, out):
    frame = frames[number]
    if not frame.get("frame_inherit"):
        return frame
    parent = frame.get("frame_parent")
    if not isinstance(parent, int) or not 0 <= parent < number:
        out.append(f"frame {number} inherits from {parent!r}")
        return frame
    return _inherited(frames, parent, out) | frame


def _frame(frame):
    out = []
    for key in frame:
        head, _, tail = key.partition("_")
        if head in KNOWN and ":" not in tail and tail not in KNOWN[head]:
            out.append(f"{key} is no property of FOLD and has no namespace")
    _words(frame, "frame_classes", FRAME_CLASSES, out)
    _words(frame, "frame_attributes", ATTRIBUTES, out)
    if frame.get("frame_unit", "unit") not in UNITS:
        out.append("frame_unit is unknown")
    _lengths(frame, out)
    if not out:
        _geometry(frame, out)
    return out


def _words(frame, key, known, out):
    words = frame.get(key, [])
    if not isinstance(words, list) or any(word not in known and ":" not in word for word in words):
        out.append(f"{key} is {words}")


def _lengths(frame, out):
    """All properties of one kind of thing are parallel arrays."""
    for kind in ("vertices", "edges", "faces"):
        sizes = {key: len(value) for key, value in frame.items() if key.startswith(kind + "_")}
        if len(set(sizes.values())) > 1:
            out.append(f"arrays of different lengths: {sizes}")


def _geometry(frame, out):
    points, edges, faces = (frame[key] for key in ("vertices_coords", "edges_vertices", "faces_vertices"))
    dimension = 2 if "2D" in frame["frame_attributes"] else 3
    if any(len(point) != dimension or not all(isinstance(x, float) for x in point) for point in points):
        out.append(f"vertices_coords are not {dimension}D")
    sides = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            sides.setdefault(frozenset((a, b)), []).append((a, b))
    if set(map(frozenset, edges)) != set(sides) or len(edges) != len(sides):
        out.append("edges_vertices are not the sides of faces_vertices")
    if "manifold" in frame["frame_attributes"] and max(map(len, sides.values())) > 2:
        out.append("not manifold")
    if "orientable" in frame["frame_attributes"] and any(len(set(pair)) < len(pair) for pair in sides.values()):
        out.append("not oriented")
    for edge, letter, angle in zip(edges, frame["edges_assignment"], frame["edges_foldAngle"], strict=True):
        _edge(edge, letter, angle, len(sides.get(frozenset(edge), [])), out)


def _edge(edge, letter, angle, faces, out):
    sign = {"M": -1, "V": 1}.get(letter, 0)
    if letter not in ASSIGNMENTS:
        out.append(f"edge {edge} is assigned {letter!r}")
    if not -180 <= angle <= 180 or (angle > 0) - (angle < 0) != sign:
        out.append(f"edge {edge} is {letter} with fold angle {angle}")
    if (letter == "B") != (faces == 1):
        out.append(f"edge {edge} is {letter} with {faces} faces")

"""The shared library through ctypes, with the structs and enums of its header, so that fields and values
that come later are known here as well."""

import ctypes
import re

SCALARS = {
    "uint32_t": ctypes.c_uint32,
    "int32_t": ctypes.c_int32,
    "uint64_t": ctypes.c_uint64,
    "int64_t": ctypes.c_int64,
    "double": ctypes.c_double,
    "char": ctypes.c_char,
}


class Refusal(Exception):
    """A status other than NM_OK, with its name and the library's message."""

    def __init__(self, name, message):
        super().__init__(f"{name}: {message}")
        self.name, self.message = name, message


def enums_of(text):
    """Returns the enums' values by name, and the names of the enums."""
    values = {}
    names = re.findall(r"^enum (nm_\w+)", text, re.M)
    for body in re.findall(r"^enum nm_\w+[^{]*\{(.*?)^\};", text, re.M | re.S):
        values |= {name: int(value) for name, value in re.findall(r"(\w+) = (\d+)", body)}
    return values, names


def structs_of(text, enums):
    """Returns a ctypes class for each struct of the header."""
    structs = {}
    for name, body in re.findall(r"^typedef struct (nm_\w+) \{(.*?)^\} nm_\w+;", text, re.M | re.S):
        fields = []
        for kind, field, length in re.findall(r"^\s*([\w ]+?[ *]+)(\w+)(?:\[(\d+)\])?;", body, re.M):
            kind = kind.strip()
            if kind in enums:
                kind = ctypes.c_int32
            else:
                kind = SCALARS.get(kind, ctypes.c_void_p)
            fields.append((field, kind * int(length) if length else kind))
        structs[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
    return structs


class Library:
    """The functions that this program calls, each of which raises Refusal."""

    def __init__(self, path, header):
        text = re.sub(r"/\*.*?\*/", "", open(header, encoding="utf-8").read(), flags=re.S)
        self.values, enums = enums_of(text)
        self.structs = structs_of(text, enums)
        self.calls = ctypes.CDLL(str(path))
        self.calls.nm_status_name.restype = ctypes.c_char_p
        self.calls.nm_mesh_free.restype = None
        self.calls.nm_last_error.restype = ctypes.c_size_t

    def call(self, name, *arguments):
        """Calls a function that answers an nm_status."""
        status = getattr(self.calls, name)(*arguments)
        if status != self.values["NM_OK"]:
            message = ctypes.create_string_buffer(2048)
            self.calls.nm_last_error(message, ctypes.c_size_t(len(message)))
            name = self.calls.nm_status_name(ctypes.c_int32(status)).decode()
            raise Refusal(name, message.value.decode())

    def struct(self, name):
        """Returns a struct whose struct_size is set."""
        made = self.structs[name]()
        made.struct_size = ctypes.sizeof(made)
        return made


class Mesh:
    """Points and segments of the plane, and their mesh."""

    def __init__(self, library, points, segments):
        self.library = library
        self.handle = ctypes.c_void_p()
        flat = [coordinate for point in points for coordinate in point]
        ends = [end for segment in segments for end in segment]
        points = (ctypes.c_double * len(flat))(*flat)
        library.call("nm_mesh_create", ctypes.c_uint32(2), ctypes.c_size_t(len(flat) // 2), points,
                     ctypes.c_size_t(0), ctypes.byref(self.handle))
        library.call("nm_mesh_set_segments", self.handle, ctypes.c_uint64(len(segments)),
                     (ctypes.c_uint32 * len(ends))(*ends), None)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.library.calls.nm_mesh_free(self.handle)

    def run(self, **options):
        """Meshes; enums are given by their names in the header."""
        made = self.library.structs["nm_options"]()
        size = ctypes.c_uint32(ctypes.sizeof(made))
        self.library.call("nm_options_init", ctypes.byref(made), size)
        for name, value in options.items():
            setattr(made, name, self.library.values.get(value, value))
        self.library.call("nm_run", self.handle, ctypes.byref(made))

    def filled(self, name, *arguments):
        """Returns the struct that a function fills, as nm_mesh_counts does."""
        made = self.library.struct({"validate": "nm_report"}.get(name, f"nm_{name}"))
        self.library.call(f"nm_mesh_{name}", self.handle, *arguments, ctypes.byref(made))
        return made

    def array(self, name, kind):
        """Returns the array of a getter as a list."""
        needed = ctypes.c_uint64()
        getter = f"nm_mesh_get_{name}"
        self.library.call(getter, self.handle, None, ctypes.c_uint64(0), ctypes.byref(needed))
        made = (kind * needed.value)()
        self.library.call(getter, self.handle, made, needed, None)
        return list(made)

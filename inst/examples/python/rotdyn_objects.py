"""Scenes of rotdyn from Python: what JSON holds, or keyword arguments, set in a loop.

The library is librotdyn.so.1, or what ROTDYN_LIBRARY names.
"""
import ctypes as c
import os

D, Z, T, P, I = c.c_double, c.c_size_t, c.c_char_p, c.c_void_p, c.c_int
Doubles = c.POINTER(D)
Law = c.CFUNCTYPE(I, Doubles, Doubles, P)


class Struct(c.Structure):
    """A struct that begins with its size; members that are not given are 0."""

    def __init__(self, **members):
        super().__init__(size=c.sizeof(self), **members)


class Options(Struct):
    _fields_ = [("size", Z), ("accuracy", D), ("model", T), ("max_steps", D)]


class Report(Struct):
    _fields_ = [("size", Z), ("status", I), ("rows_done", Z), ("time_s", D), ("steps", Z),
                ("rejected", Z), ("law_calls", Z), ("error", D), ("error_is_bound", I),
                ("n_measures", Z), ("measure", T * 8), ("measure_error", D * 8),
                ("measure_largest", D * 8), ("model", T), ("index", T), ("rows_per_time", Z),
                ("input", T), ("reason", c.c_char * 512)]


class Candidate(Struct):
    _fields_ = [("size", Z), ("model", T), ("applies", I), ("error", D), ("error_is_bound", I),
                ("cost_s", D), ("reason", c.c_char * 512)]


class Balance(Struct):
    _fields_ = [("size", Z), ("quantity", T), ("about", T), ("unit", T), ("change", D),
                ("supplied", D), ("dissipated", D), ("residual", D), ("explained", D),
                ("balanced", I), ("conserved", I), ("why", c.c_char * 512), ("n_terms", Z),
                ("term", T * 16), ("role", I * 16), ("value", D * 16)]


lib = c.CDLL(os.environ.get("ROTDYN_LIBRARY", "librotdyn.so.1"))
for name, result, arguments in (
    ("status_text", T, [I]), ("object_at", T, [Z]), ("object_kind", T, [T]),
    ("column_at", T, [T, Z]), ("object_new", P, [T]), ("object_free", None, [P]),
    ("set_number", I, [P, T, D]), ("set_numbers", I, [P, T, Z, Doubles]),
    ("set_text", I, [P, T, T]), ("set_object", I, [P, T, P]), ("set_law", I, [P, T, Law, P]),
    ("unset", I, [P, T]), ("object_check", I, [P, P]),
    ("scene_candidate", I, [P, Z, Doubles, P, Z, P]),
    ("scene_run", I, [P, Z, Doubles, P, Z, Z, c.POINTER(T), c.POINTER(Doubles), P]),
    ("scene_balance", I, [P, Z, Doubles, P, Z, P, P]),
):
    function = getattr(lib, "rotdyn_" + name)
    function.restype, function.argtypes = result, arguments


class Refused(ValueError):
    pass


def doubles(values):
    return (D * len(values))(*values)


class Object:
    """An object by the name of its constructor; `arguments` as JSON has them:

    a number, a text, a list, None, another Object, a function of the arguments of a law, or
    {constructor: arguments}; arguments alone are those of the constructor that the input names.
    """

    def __init__(self, constructor, arguments):
        self.kept = []
        self.pointer = lib.rotdyn_object_new(constructor.encode())
        if not self.pointer:
            raise Refused(f"there is no {constructor}()")
        for name, value in arguments.items():
            self.put(name.encode(), value, name)

    def __del__(self):
        lib.rotdyn_object_free(self.pointer)

    def put(self, key, value, name):
        """Sets the input `key`, or adds an item to a list (None) for the input `name`."""
        if value in ("Inf", "-Inf"):
            value = float(value)
        if isinstance(value, dict):
            (constructor, arguments), *more = list(value.items()) or [(None, None)]
            known = constructor and lib.rotdyn_object_kind(constructor.encode())
            value = Object(constructor, arguments) if known and not more else Object(name, value)
        numbers = isinstance(value, list) and all(isinstance(x, (int, float)) for x in value)
        if isinstance(value, list) and not (numbers and value):
            items, value = value, Object("list", {})
            for item in items:
                value.put(None, item, name)
        if value is None:
            status = lib.rotdyn_unset(self.pointer, key)
        elif isinstance(value, str):
            status = lib.rotdyn_set_text(self.pointer, key, value.encode())
        elif isinstance(value, list):
            status = lib.rotdyn_set_numbers(self.pointer, key, len(value), doubles(value))
        elif isinstance(value, Object):
            self.kept += value.kept
            status = lib.rotdyn_set_object(self.pointer, key, value.pointer)
        elif callable(value):
            def call(argument, to, context, f=value):
                result = f(argument)
                for k, x in enumerate(result if isinstance(result, (list, tuple)) else [result]):
                    to[k] = x
                return 0
            law = Law(call)
            self.kept.append(law)
            status = lib.rotdyn_set_law(self.pointer, key, law, None)
        else:
            status = lib.rotdyn_set_number(self.pointer, key, value)
        if status:
            raise Refused(f"{name}: {lib.rotdyn_status_text(status).decode()}")


def columns_of(constructor):
    names, i = [], 0
    while lib.rotdyn_column_at(constructor.encode(), i):
        names.append(lib.rotdyn_column_at(constructor.encode(), i).decode())
        i += 1
    return names


def run(constructor, arguments, time_s, columns=None, accuracy=0.0, model=None):
    """The report and {column: values} of a motion."""
    scene = Object(constructor, arguments)
    columns = columns or columns_of(constructor)
    report = Report()
    if lib.rotdyn_object_check(scene.pointer, c.byref(report)):
        raise Refused(f"{(report.input or b'').decode()} {report.reason.decode()}")
    room = len(time_s) * report.rows_per_time
    out = [(D * room)() for _ in columns]
    options = Options(accuracy=accuracy, model=model.encode() if model else None)
    status = lib.rotdyn_scene_run(
        scene.pointer, len(time_s), doubles(time_s), c.byref(options), room, len(columns),
        (T * len(columns))(*(name.encode() for name in columns)),
        (Doubles * len(columns))(*(c.cast(x, Doubles) for x in out)), c.byref(report))
    if status:
        raise Refused(f"{lib.rotdyn_status_text(status).decode()}: {report.reason.decode()}")
    return report, {name: list(values) for name, values in zip(columns, out)}


def candidates(constructor, arguments, time_s, accuracy=0.0):
    """The models, cheapest first, each with the reason against it, or what it ignores."""
    scene, options, one = Object(constructor, arguments), Options(accuracy=accuracy), Candidate()
    k, found = 0, []
    while lib.rotdyn_scene_candidate(scene.pointer, len(time_s), doubles(time_s),
                                     c.byref(options), k, c.byref(one)) == 0:
        found.append((one.model.decode(), one.reason.decode()))
        k += 1
    return found


def audit(constructor, arguments, time_s, accuracy=0.0):
    """The balances between the first and the last time: [(quantity, residual, explained, verdict)]."""
    scene, options, one = Object(constructor, arguments), Options(accuracy=accuracy), Balance()
    verdict = {1: "balanced", 0: "unbalanced", -1: "not known"}
    k, found = 0, []
    while lib.rotdyn_scene_balance(scene.pointer, len(time_s), doubles(time_s), c.byref(options),
                                   k, c.byref(one), None) == 0:
        found.append((one.quantity.decode(), one.residual, one.explained, verdict[one.balanced]))
        k += 1
    return found

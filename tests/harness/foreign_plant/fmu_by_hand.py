#!/usr/bin/env python3
"""An exported axis by another hand: zipfile, ElementTree and ctypes, no code of the bench.

usage: fmu_by_hand.py ROOT BENCH

Goes through the unit as FMI 3.0 has it, and holds it to the mechanics of the rigid machine that its
parameters describe: (3.33), J w = integral of K_T i - B w - C, by the trapezoid rule over 1 ms.
"""
import ctypes as c
import os
import subprocess
import sys
import tempfile
import zipfile
from xml.etree import ElementTree

PLANT = """schema = 1
[axis.y]
inertia_kg_m2 = 3.0e-5
viscous_friction_Nm_s_per_rad = 2.0e-5
coulomb_friction_Nm = 3.0e-3
gear_ratio = 10.0
sprocket_radius_m = 0.02
torque_constant_Nm_per_A = 50e-3
amplifier_gain_A_per_V = 0.5
pwm_amplitude_V = 10.0
current_limit_A = 3.0
encoder_counts_per_rev = 4000
[axis.y.friction]
breakaway_Nm = 3.0e-3
[axis.y.friction.position]
position_m = []
friction_Nm = []
[supply]
voltage_V = 48.0
"""
RIG = 'schema = 1\nname = "hand"\nplants = ["plant.toml"]\n[axis.y]\nstart_m = 0.5\n'
LOG = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)


def check(good, what):
    if not good:
        sys.exit(f"fmu_by_hand: {what}")


def exported(bench, folder):
    for name, text in (("plant.toml", PLANT), ("rig.toml", RIG)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    unit = os.path.join(folder, "y.fmu")
    subprocess.run([bench, "export-fmu", os.path.join(folder, "rig.toml"), "--axis", "y", "--out", unit],
                   check=True, stdout=subprocess.DEVNULL)
    with zipfile.ZipFile(unit) as archive:
        check(archive.testzip() is None, "a broken archive")
        archive.extractall(os.path.join(folder, "unit"))
    return os.path.join(folder, "unit")


class Unit:
    def __init__(self, folder):
        root = ElementTree.parse(os.path.join(folder, "modelDescription.xml")).getroot()
        check(root.tag == "fmiModelDescription" and root.get("fmiVersion") == "3.0", "no FMI 3.0")
        order = [child.tag for child in root]
        check(order == ["CoSimulation", "UnitDefinitions", "DefaultExperiment", "ModelVariables", "ModelStructure"],
              f"elements in the order {order}")
        units = {unit.get("name") for unit in root.find("UnitDefinitions")}
        variables = list(root.find("ModelVariables"))
        check(all(v.get("unit") in units for v in variables if v.tag == "Float64"), "a unit that is not defined")
        self.reference = {v.get("name"): int(v.get("valueReference")) for v in variables}
        check(len(set(self.reference.values())) == len(variables), "two variables of one reference")
        outputs = {int(v.get("valueReference")) for v in variables if v.get("causality") == "output"}
        check({int(o.get("valueReference")) for o in root.iter("Output")} == outputs, "outputs left out of the structure")
        identifier = root.find("CoSimulation").get("modelIdentifier")
        self.lib = c.CDLL(os.path.join(folder, "binaries/x86_64-linux", identifier + ".so"))
        self.lib.fmi3InstantiateCoSimulation.restype = c.c_void_p
        self.lib.fmi3GetVersion.restype = c.c_char_p
        check(self.lib.fmi3GetVersion() == b"3.0", "another version in the binary")
        self.log = LOG(lambda environment, status, category, message: print("unit:", message.decode()))
        b = c.c_bool
        self.instance = c.c_void_p(self.lib.fmi3InstantiateCoSimulation(
            b"hand", root.get("instantiationToken").encode(), (folder + "/resources/").encode(), b(False), b(False),
            b(False), b(False), None, c.c_size_t(0), None, self.log, None))
        check(self.instance.value, "no instance")

    def done(self, status, what):
        check(status == 0, f"{what}: status {status}")

    def initialise(self):
        self.done(self.lib.fmi3EnterInitializationMode(self.instance, c.c_bool(False), c.c_double(0), c.c_double(0),
                                                       c.c_bool(False), c.c_double(0)), "enter initialisation")
        self.done(self.lib.fmi3ExitInitializationMode(self.instance), "exit initialisation")

    def set(self, name, value):
        self.done(self.lib.fmi3SetFloat64(self.instance, c.byref(c.c_uint32(self.reference[name])), c.c_size_t(1),
                                          c.byref(c.c_double(value)), c.c_size_t(1)), f"set {name}")

    def get(self, name):
        value = c.c_double()
        self.done(self.lib.fmi3GetFloat64(self.instance, c.byref(c.c_uint32(self.reference[name])), c.c_size_t(1),
                                          c.byref(value), c.c_size_t(1)), f"get {name}")
        return value.value

    def step(self, time, step):
        flags = [c.c_bool(), c.c_bool(), c.c_bool()]
        last = c.c_double()
        status = self.lib.fmi3DoStep(self.instance, c.c_double(time), c.c_double(step), c.c_bool(True),
                                     *[c.byref(flag) for flag in flags], c.byref(last))
        return status, last.value


def main():
    bench = sys.argv[2]
    with tempfile.TemporaryDirectory() as folder:
        unit = Unit(exported(bench, folder))
        unit.initialise()
        check(abs(unit.get("position_m") - 0.5) < 1e-12, "another start")
        unit.set("command_V", 2.0)
        impulse, before = 0.0, None
        for i in range(200):
            status, last = unit.step(i * 1e-3, 1e-3)
            check(status == 0 and abs(last - (i + 1) * 1e-3) < 1e-12, f"step {i}")
            torque = 50e-3 * unit.get("current_A") - 2.0e-5 * unit.get("motor_speed_rad_per_s") - 3.0e-3
            impulse += 1e-3 * 0.5 * ((torque if before is None else before) + torque)
            before = torque
        ratio = 3.0e-5 * unit.get("motor_speed_rad_per_s") / impulse
        check(abs(ratio - 1) < 1e-3, f"the speed is {ratio} of what the torque gives")
        # 0.5 A/V times 2 V, less what the rising back EMF costs the current loop.
        check(0.98 < unit.get("current_A") < 1.0, f"a current of {unit.get('current_A')} A")
        metres = unit.get("motor_angle_rad") * 0.02 / 10.0
        check(abs(unit.get("position_m") - metres) < 1e-9, "load and motor apart on a rigid transmission")
        state = c.c_void_p()
        unit.done(unit.lib.fmi3GetFMUState(unit.instance, c.byref(state)), "get state")
        unit.step(0.2, 0.1)
        first = unit.get("position_m")
        unit.done(unit.lib.fmi3SetFMUState(unit.instance, state), "set state")
        unit.step(0.2, 0.1)
        check(unit.get("position_m") == first, "another way from one state")
        unit.done(unit.lib.fmi3FreeFMUState(unit.instance, c.byref(state)), "free state")
        check(unit.step(0.3, 1.5e-4)[0] == 3, "a step that is no whole number of ticks is taken")
        unit.done(unit.lib.fmi3Terminate(unit.instance), "terminate")
        unit.lib.fmi3FreeInstance(unit.instance)


main()

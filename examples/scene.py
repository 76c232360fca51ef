"""Two boxes on a slope of 25 degrees: rubber sticks, ice slides. Twin: scene.cpp."""

import tumble

scene = tumble.Scene("Two boxes on a slope", duration=1)
scene.add_material("wood", friction=0.4)
scene.add_material("rubber", friction=0.9)
scene.add_material("ice", friction=0.1)
scene.add_fixed(tumble.half_plane(), name="slope", angle="25 deg", material="wood")
for name, x in (("rubber", 0.5), ("ice", -0.5)):
    box = tumble.square(0.25).moved((x, 0.125))  # drawn on level ground, then turned with it
    scene.add_body(box, mass=2, name=name, angle="25 deg", material=name)

run = tumble.simulate(scene, sample_every=250)
print("time [s]  way of rubber [m]  way of ice [m]")
for k, t in enumerate(run.time):
    ways = (run[name].x[k] - run[name].x[0] for name in ("rubber", "ice"))
    print("{:8.3f}  {:17.6f}  {:14.6f}".format(t, *ways))
rows = run.contacts_of("ice")
last = rows[rows["step"] == run.num_steps]
print(f"the slope carries {last['normal_impulse'].sum() / run.step_size:.6f} N of the ice, {last['mode'][0]}")
print(f"{run.status}, largest residual below 1e-10: {'yes' if run.residual < 1e-10 else 'no'}")

"""An arm with a gripper and a drone as wheels might hold them, of boxes and capsules: joints, hand and rotors called as the real ones."""


def _finger(side: str, sign: int) -> str:
    low, high = (-0.002, 0.0376) if sign > 0 else (-0.0376, 0.002)
    return f"""<body name="link_{side}_finger" pos="{0.0035 * sign} -0.044 0.1065"><joint name="{side}_finger" type="slide" axis="1 0 0"
      range="{low} {high}"/>
      <body name="{side}_down" pos="0 0 0.01" quat="0 0 1 1"><geom name="{side}_pad" type="box" size="0.002 0.04 0.006" pos="0 -0.01 0" mass="0.1"/>
      </body></body>"""


ARM = f"""<mujoco model="arm"><compiler angle="radian"/>
  <default><geom contype="1" conaffinity="1"/><joint axis="0 1 0"/></default>
  <worldbody><body name="arm"><geom type="cylinder" size="0.04 0.03" pos="0 0 0.03" mass="1"/>
    <body name="link_1" pos="0 0 0.06"><joint name="joint1" axis="0 0 1" range="-2.6 3"/><geom size="0.03" mass="0.2"/>
    <body name="link_2" pos="0 0 0.05"><joint name="joint2" range="0 3.66"/>
      <geom type="capsule" fromto="-0.03 0 0 -0.23 0 0" size="0.025" mass="1.2"/>
    <body name="link_3" pos="-0.26 0 0"><joint name="joint3" axis="0 -1 0" range="0 3.66"/>
      <geom type="capsule" fromto="0.03 0 0.06 0.22 0 0.06" size="0.025" mass="0.8"/>
    <body name="link_4" pos="0.25 0 0.06"><joint name="joint4" range="-1.57 1.57"/><geom size="0.025" mass="0.4"/>
    <body name="link_5" pos="0.06 0 0"><joint name="joint5" axis="0 0 1" range="-1.57 1.57"/><geom size="0.025" mass="0.3"/>
    <body name="link_6" pos="0.04 0 0.04" quat="0.5 0.5 0.5 0.5"><joint name="joint6" axis="0 0 1" range="-2.1 2.1"/>
      <geom type="box" size="0.05 0.02 0.012" pos="0 -0.03 0.04" mass="0.3"/>
      {_finger("left", 1)}{_finger("right", -1)}
    </body></body></body></body></body></body></body></worldbody>
  <equality><joint joint1="left_finger" joint2="right_finger" polycoef="0 -1 0 0 0"/></equality></mujoco>"""
"""Folded as it lies in its file: the hand points along +X, its fingers closed."""
DRONE = """<mujoco model="drone"><worldbody><body name="drone"><inertial pos="0 0 0" mass="0.0434" diaginertia="2.4e-5 2.4e-5 3.2e-5"/>
  <geom name="col_box" type="box" size="0.07 0.07 0.02" contype="0" conaffinity="0"/><geom name="col_sphere" size="0.086"/>
  <site name="motor0" pos="0.03536 -0.03536 0"/><site name="motor1" pos="-0.03536 -0.03536 0"/>
  <site name="motor2" pos="-0.03536 0.03536 0"/><site name="motor3" pos="0.03536 0.03536 0"/></body></worldbody>
  <actuator><motor site="motor0"/></actuator></mujoco>"""

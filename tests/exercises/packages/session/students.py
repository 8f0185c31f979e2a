"""Sessions for packages.session: right ones in four styles, then wrong ones, each named by its defect."""

from grader.exercises.packages.session.watchman_package import FILES
from tests.students.workspaces import Workspace, changed

PARTS = ("FILES", "RIGHT", "CREATE", "CREATION", "created", "SET_UP", "START", "CALL", "SIGN", "DRIVE", "typed", "but")
SET_UP = "export ROS_DOMAIN_ID=42 ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST"
START = "ros2 run watchman watch --ros-args -r drive:=cmd_vel"
CALL = "ros2 service call /watchman/patrol std_srvs/srv/SetBool"
SIGN = 'ros2 topic pub --once /logbook std_msgs/msg/String "{data: badge 7306}"'
CREATE = "ros2 pkg create lantern --build-type ament_python --node-name shine --dependencies rclpy std_msgs"
CREATION = f"""\
# terminal 4
cd ws/src
{CREATE}
cd ..
colcon build --packages-select lantern
source install/setup.bash
{SET_UP}
ros2 run lantern shine
# terminal 1
"""
RIGHT = f"""\
# terminal 1
python -m sim --world room

# terminal 2
cd ws
colcon build --packages-select watchman
source install/setup.bash
{SET_UP}
{START}

# terminal 3
{SET_UP}
ros2 node info /watchman
ros2 topic echo --once /watchman/badge
{SIGN}
{CALL} "{{data: true}}"
sleep 6
ros2 param set /watchman pace 0.25
sleep 6
{CALL} "{{data: false}}"

# terminal 2
Ctrl-C
"""


def typed(text: str, creation: str = CREATION) -> Workspace:
    """The package as it was given, with a session that begins with a package of one's own."""
    return Workspace(__name__, {**FILES, "watchman/session.txt": creation + text})


def but(old: str, new: str) -> Workspace:
    """The right session with other lines."""
    assert old in RIGHT
    return typed(RIGHT.replace(old, new))


Session = typed(RIGHT)
WithPrompts = typed(f"""\
$ cd /home/ann/ros2-course/exercises/11_packages/ws/src/..
$ ls
$ colcon build --symlink-install
$ . install/local_setup.bash
$ export ROS_DOMAIN_ID=42
$ ros2 run watchman watch --ros-args \\
    --remap drive:=/cmd_vel -r __node:=guard
# terminal B
$ ROS_DOMAIN_ID=42 ros2 topic pub -t 3 /logbook std_msgs/msg/String 'data: "7306"'
$ ROS_DOMAIN_ID=42 {CALL.replace("watchman", "guard")} '{{"data": true}}'
$ sleep 6.5s
$ ROS_DOMAIN_ID=42 ros2 param set guard pace 0.25
# terminal C
$ sleep 6
$ ROS_DOMAIN_ID=42 {CALL.replace("watchman", "guard")} 'data: false'
# terminal 1
ctrl+c
""")
FourTerminals = typed(f"""\
# Terminal robot:
{SET_UP}
python3 -m sim --world maze --headless
# Terminal program:
cd ws
colcon build
source install/setup.bash
{SET_UP}
ros2 run watchmen watch
{START}
# Terminal listener:
{SET_UP}
ros2 topic echo /odom --field pose.pose.position
# Terminal commands:
{SET_UP}
{CALL} "data: true"
{SIGN.replace("--once", "--times 2")}
sleep 4
ros2 param set /watchman pace 0.25
sleep 8
{CALL} "data: false"
# Terminal listener:
Ctrl-C
# Terminal program:
Ctrl-C
# Terminal robot:
Ctrl-C
""")
OnceMore = typed(  # a design of its own: it is started once more, to stop the robot by a command
    f"""\
cd ws
colcon build
source install/setup.bash
{SET_UP}
{START} -p pace:=0.1
# terminal 2
{SET_UP}
{CALL} "data: true"
sleep 6
ros2 param set /watchman pace 0.25
{SIGN.replace("--once", "-r 1")}
# terminal 1
Ctrl-C after 8 s
{START}
# terminal 2
Ctrl-C
{CALL} "data: false"
# terminal 1
Ctrl-C after 1.5
"""
)
InDomain7 = typed(RIGHT.replace("--world room", "--world room --domain 7").replace("ID=42", "ID=7"))
GuessesFirst = but(  # a person ends what waits for a name that isn't there
    f'{CALL} "{{data: true}}"', f'{CALL.replace("patrol", "start")} "{{data: true}}"\n{CALL} "{{data: true}}"'
)

def created(old: str, new: str) -> Workspace:
    """The right session, with other lines about the student's own package."""
    assert old in CREATION
    return typed(RIGHT, CREATION.replace(old, new))


InOneGo = typed(
    RIGHT.replace("colcon build --packages-select watchman", f"{CREATE} --destination-directory src\ncolcon build")
    .replace(START, f"ros2 run lantern shine\n{START}"),
    "",
)  # fmt: skip
NeverCreated = typed(RIGHT, "")
OtherName = created("lantern", "latern")
NotInSrc = typed(RIGHT, CREATION.replace("cd ws/src\n", "cd ws\n").replace("cd ..\n", ""))
OfCpp = created("--build-type ament_python ", "")
NoProgram = created("--node-name shine ", "")
OtherProgram = created("shine", "shines")
OneNeed = created(" std_msgs", "")
NewNotBuilt = created("colcon build --packages-select lantern\n", "")
BuiltTooEarly = created(
    f"{CREATE}\ncd ..\ncolcon build --packages-select lantern\n", f"cd ..\ncolcon build\ncd src\n{CREATE}\ncd ..\n"
)
SourcedTooEarly = typed(
    RIGHT,
    CREATION.replace("cd ws/src\n", "cd ws\ncolcon build\nsource install/setup.bash\ncd src\n").replace(
        "select lantern\nsource install/setup.bash\n", "select lantern\n"
    ),
)
NewNotStarted = created("ros2 run lantern shine\n", "")
NotBuilt = but("colcon build --packages-select watchman\n", "")
BuiltElsewhere = but("cd ws\n", "cd ws/src\n")
OtherPackage = but("select watchman", "select watchmen")
NotSourced = but("source install/setup.bash\n", "")
SourcedElsewhere = but(
    "source install/setup.bash\n", "# terminal 3\nsource ws/install/setup.bash\n# terminal 2\n"
)
SourcedTooDeep = but("source install/setup.bash", "source ws/install/setup.bash")
SourcedBefore = typed(
    RIGHT.replace("source install/setup.bash\n", "").replace("cd ws\n", "cd ws\nsource install/setup.bash\n")
)
NoDomain = but(SET_UP + "\n" + START, START)
ByTheVariable = typed(
    RIGHT.replace("python -m sim", "export ROS_DOMAIN_ID=7\npython -m sim").replace("ID=42", "ID=7")
)
OtherDomain = but("--world room", "--world room --domain 7")
NoDomainThere = but(SET_UP + "\nros2 node", "ros2 node")
MisspeltPackage = but("run watchman watch", "run watchmen watch")
MisspeltProgram = but("run watchman watch", "run watchman watsh")
MisspeltCommand = but("ros2 run", "rso2 run")
MisspeltVerb = but("ros2 run", "ros2 rum")
NoRemapping = but(" --ros-args -r drive:=cmd_vel", "")
MisspeltTopic = but("drive:=cmd_vel", "drive:=cmd_val")
NoRosArgs = but("--ros-args -r", "-r")
WithAnd = but("cd ws\n", "cd ws && colcon build\n")
WithAPipe = but(SIGN, f"{SIGN} | head")
InTheBackground = but(START, START + " &")
WithAVariable = but("cd ws\n", "cd $HOME/ws\n")
NoQuotes = but('"{data: true}"', "{data: true}")
OpenQuote = but('"{data: true}"', '"{data: true}')
MisspeltField = but('"{data: true}"', '"{date: true}"')
NoSpace = but('"{data: true}"', '"{data:true}"')
ShortType = but(CALL + ' "{data: true}"', 'ros2 service call /watchman/patrol SetBool "{data: true}"')
MisspeltService = but(CALL + ' "{data: true}"', CALL.replace("patrol", "patrl") + ' "{data: true}"')
NeverCalled = but(CALL + ' "{data: true}"\n', "")
InOneTerminal = typed(RIGHT.replace("# terminal 3\n", "").replace("# terminal 2\nCtrl-C", "Ctrl-C"))
InTheRobotsTerminal = but("\n# terminal 2\ncd", "\ncd")
TooShort = but("sleep 6\nros2 param", "sleep 2\nros2 param")
TooShortAtLast = but(f"sleep 6\n{CALL}", f"sleep 1\n{CALL}")
MisspeltParameter = but("pace 0.25", "speed 0.25")
WholeNumber = but("pace 0.25", "pace 1")
MisspeltNode = but("set /watchman", "set /watchmen")
OtherPace = but("pace 0.25", "pace 0.3")
NeverFaster = but("ros2 param set /watchman pace 0.25\n", "")
FastFromTheStart = but("drive:=cmd_vel", "drive:=cmd_vel -p pace:=0.25")
StartedAgain = but(
    "ros2 param set /watchman pace 0.25\n",
    f"# terminal 2\nCtrl-C\n{START} -p pace:=0.25\n# terminal 3\n{CALL} 'data: true'\n",
)
NoSuchTime = but("sleep 6\nros2 param", "sleep six\nros2 param")
OtherNumber = but("badge 7306", "badge 1234")
NeverSigned = but(SIGN + "\n", "")
SignedElsewhere = but("/logbook std", "/logbok std")
StillDriving = but(f'{CALL} "{{data: false}}"\n', "")
StillRunning = but("\n# terminal 2\nCtrl-C\n", "")
ByHand = typed(f"""\
{SET_UP}
ros2 topic pub -t 100 -r 10 /cmd_vel geometry_msgs/msg/Twist "{{linear: {{x: 0.1}}}}"
ros2 topic pub -t 100 -r 10 /cmd_vel geometry_msgs/msg/Twist "{{linear: {{x: 0.25}}}}"
""")
DrivesByItself = Workspace(
    __name__,
    changed(
        {**FILES, "watchman/session.txt": CREATION + RIGHT},
        "watchman/watchman/watch.py",
        "patrols = False",
        "patrols = True",
    ),
)
OnlyBuilds = typed("cd ws\ncolcon build\nsource install/setup.bash\n")
NothingTyped = typed("# terminal 1\n", "")
NoSession = Workspace(__name__, dict(FILES))
NotStarted = typed("# YOUR CODE HERE\nraise NotImplementedError()\n", "")
DRIVE = "ros2 topic pub -n watchman -t 60 -r 10 /cmd_vel geometry_msgs/msg/Twist"
OnlyItsName = typed(f"""\
{SET_UP}
{DRIVE} "{{linear: {{x: 0.1}}}}"
{DRIVE} "{{linear: {{x: 0.25}}}}"
{DRIVE.replace("-t 60", "-t 5")} "{{linear: {{x: 0.0}}}}"
{SIGN}
""")

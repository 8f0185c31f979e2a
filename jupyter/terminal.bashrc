# Read by the terminals of JupyterLab: the user's own settings, completion of ros2, and the folder of the student's files.
[ -f ~/.bashrc ] && . ~/.bashrc
[ "$PWD" = "$ROS2_COURSE" ] && [ -d "$JUPYTER_SERVER_ROOT" ] && cd "$JUPYTER_SERVER_ROOT"
command -v register-python-argcomplete > /dev/null && eval "$(register-python-argcomplete ros2)"

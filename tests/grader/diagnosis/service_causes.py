"""What goes wrong with services and actions without an error, and the sentence for each."""

from tests.students import service_misfits as misfits
from tests.students.engine import actions, callers, goals, services

TYPO = "/customer calls /add, {}: two different services. "
SPIN = (
    "never received it: answers come in while the node spins. Call rclpy.spin(node), or "
    "rclpy.spin_until_future_complete(node, future)."
)
FIRST = "two programs need a moment to discover each other, and what is sent before that is lost. Wait first:"
IN_VAIN = ", but no node offers it. Is the server running, and is the name right?"
NEVER_RAN = (
    "but none of its callbacks ever ran. Callbacks run while the node spins: call rclpy.spin(node) in main()."
)
THREADS = (
    "the execute callback kept the node busy. Spin the node with a MultiThreadedExecutor, or let execute await a pause instead of calling time.sleep."
)
LOOK = (
    "Check goal_handle.is_cancel_requested in the loop: when it is True, call goal_handle.canceled() and return "
    "the result."
)
DROPPED = "was started with a value for the parameter {}, which it doesn't declare, and ROS ignores it silently."

SERVICE_CAUSES = {
    (misfits.launch_with_a_typo,): f"/wheel {DROPPED.format('`radios`')} Did you mean `radius`?",
    (
        misfits.launch_with_another_parameter,
    ): f"/wheel {DROPPED.format('`mass`')} It declares `radius`, `name`.",
    (misfits.launch_with_a_parameter_for_none,): f"/adder {DROPPED.format('`mass`')} It declares none.",
    (misfits.MisspeltService, services.done_callback): TYPO.format("/adder offers /ad")
    + "Is /ad a typo? Did you mean /add?",
    (misfits.ServiceInNamespace, services.until_future_complete): TYPO.format(
        "/robot1/adder offers /robot1/add"
    )
    + "Only the namespace differs: write /add. A name that starts with a slash is taken as it is; without the slash "
    "the node's namespace is put before it.",
    (
        misfits.MisspeltAction,
        goals.asks_no_one,
    ): "/client calls /fibonacci, /server offers /fibonaci: two different "
    "actions. Is /fibonaci a typo? Did you mean /fibonacci?",
    (services.until_future_complete,): f"/customer has a client for the service /add{IN_VAIN}",
    (services.no_one_answers,): f"/customer has a client for the service /add{IN_VAIN}",
    (goals.asks_no_one,): f"/client has a client for the action /fibonacci{IN_VAIN}",
    (
        services.Wheel,
        misfits.asks_another_node,
    ): "/asker calls get_parameters of the node /wheels, but there are only /wheel, /asker.",
    (
        services.done_callback,
        services.late_adder,
    ): f"/customer called /add at 0 s, before it had found /adder: {FIRST} "
    "`while not client.wait_for_service(timeout_sec=1.0)`.",
    (
        services.Adder,
        callers.AsksAtOnce,
    ): f"/customer called /add at 0 s, before it had found /adder: {FIRST} "
    "`while not client.wait_for_service(timeout_sec=1.0)`.",
    (
        goals.asks_no_one,
        actions.late_server,
    ): f"/client called /fibonacci at 0 s, before it had found /server: {FIRST} "
    "`while not client.wait_for_server(timeout_sec=1.0)`.",
    (
        actions.Server,
        goals.AsksAtOnce,
    ): f"/client called /fibonacci at 0 s, before it had found /server: {FIRST} "
    "`while not client.wait_for_server(timeout_sec=1.0)`.",
    (misfits.adder_that_no_one_spins, services.done_callback): "/adder has a service with requests waiting, "
    + NEVER_RAN,
    (
        misfits.server_that_no_one_spins,
        actions.Client,
    ): f"/server has an action with goals waiting, {NEVER_RAN}",
    (
        services.Adder,
        callers.never_spins,
    ): "/customer called /add at 0 s, and the answer came at 0 s, but /customer " + SPIN,
    (
        actions.Server,
        goals.never_spins,
    ): "/client called /fibonacci at 0 s, and the answer came at 0 s, but /client " + SPIN,
    (
        goals.JudgesWithTrue,
        actions.Client,
    ): "A goal callback returned something other than a GoalResponse, so the goal was rejected: return GoalResponse.ACCEPT or GoalResponse.REJECT.",
    (
        actions.Forgetful,
        actions.Client,
    ): "The execute callback of /fibonacci returned without setting the goal's final state, which counts as aborted: call goal_handle.succeed() before you return the result.",
    (
        actions.Server,
        actions.Impatient,
    ): "/client requested at 1.5 s that its goal be canceled, but /server received it only at 3 s: " + THREADS,
    (
        goals.Busy,
        actions.Impatient,
    ): f"/client requested at 1.5 s that its goal be canceled, but /server never received it: {THREADS}",
    (goals.parallel(goals.IgnoresCancel), actions.Impatient): f"/server agreed at 1.5 s to cancel the goal of /fibonacci, but carried on until it succeeded at 3 s. {LOOK}",
    (
        goals.parallel(goals.AbortsOnCancel),
        actions.Impatient,
    ): f"/server agreed at 1.5 s to cancel the goal of /fibonacci, but carried on until it was aborted at 2 s. {LOOK}",
    (
        goals.parallel(goals.Busy),
        actions.Impatient,
    ): f"/server agreed at 1.5 s to cancel the goal of /fibonacci, but carried on anyway. {LOOK}",
    (
        goals.parallel(goals.AlwaysRejectsCancel),
        actions.Impatient,
    ): "/server refused at 1.5 s to cancel the goal of "
    "/fibonacci. Without a cancel_callback an ActionServer always refuses: give it one that returns "
    "CancelResponse.ACCEPT.",
    (
        misfits.NeverSetsTheSum,
        services.done_callback,
    ): "Every answer of /add is empty: its callback never sets a field "
    "of the response. Set them before you return it, as in `response.sum = ...`.",
    (
        services.SlowAdder,
        misfits.NoOneReceives,
    ): "/customer called /add at 1 s, and the answer came at 1.5 s, but no "
    "callback received it: `call_async(request).add_done_callback(self.on_response)` names the method that receives it.",
}

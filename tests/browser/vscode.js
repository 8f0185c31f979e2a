async (scripts) => {
    // A page that shows outputs as VS Code does: its own manager of widgets, in a frame, on a kernel of the server.
    // The frame's parent is JupyterLab, which has the connection to the kernel; VS Code's extension has one of the same kind.
    const { kernels } = parent.jupyterapp.serviceManager;
    const kernel = await kernels.startNew({ name: "python3" });
    await kernel.info;
    (await import(scripts.renderer)).activate();
    window.vscIPyWidgets8.load();
    const loader = {
        widgetsRegisteredInRequireJs: new Set(),
        loadWidgetScript: async (name) => requirejs.config({ paths: { [name]: scripts.widgets + name + "/index" } }),
        successHandler() {},
        errorHandler: (...error) => { throw new Error(error.join(" ")); },
    };
    const manager = new window.vscIPyWidgets.WidgetManager(kernel, document.body, loader, () => {}, undefined);
    const WIDGET = "application/vnd.jupyter.widget-view+json";

    // HTML is put in as VS Code's renderer does it: scripts run when they are made anew.
    const put = (node, html) => {
        node.innerHTML = html;
        for (const script of node.querySelectorAll("script")) {
            const again = document.createElement("script");
            for (const { name, value } of script.attributes) again.setAttribute(name, value);
            again.text = script.text;
            script.replaceWith(again);
        }
    };
    const show = async (node, { data, metadata }) => {
        if (data[WIDGET]) {
            const model = await manager.get_model(data[WIDGET].model_id);
            await manager.display_view(data, await manager.create_view(model), { node });
        } else {
            put(node, data["text/html"] ?? `<pre>${data["text/plain"]}</pre>`);
        }
    };
    const outputs = new Map();
    window.execute = async (code) => {
        let said = "";
        const future = kernel.requestExecute({ code });
        future.onIOPub = ({ header, content }) => {
            if (header.msg_type === "stream") said += content.text;
            if (header.msg_type === "error") said += content.evalue;
            if (header.msg_type === "display_data") {
                const node = document.body.appendChild(document.createElement("div"));
                outputs.set(content.transient?.display_id, node);
                show(node, content);
            }
        };
        await future.done;
        return said;
    };
    kernel.iopubMessage.connect((_, { header, content }) => {
        if (header.msg_type === "update_display_data") show(outputs.get(content.transient.display_id), content);
    });
    window.shutDown = () => kernel.shutdown();
}

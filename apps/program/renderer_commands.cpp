#include "apps/build/command.h"
#include "apps/frontend/machine/machine_command.h"
#include "apps/help/list_command.h"
#include "apps/info/command.h"
#include "apps/program/commands.h"
#include "apps/program/demo.h"
#include "apps/render/command.h"
#include "apps/scene/scene_command.h"
#include "apps/view/command.h"

namespace dmpc::apps {

void declare_renderer(Commands& commands) {
  commands.add("render", "Render a scene on N nodes", RenderOptions(),
               [](const RenderOptions& options, Interrupt& interrupt, std::ostream& output) {
                 return render_command(options, interrupt, output);
               });
  commands.add("view", "Explore a scene in a browser", ViewOptions(), view_command);
  commands.add("info", "Describe a scene, and forecast what a render of it takes", InfoOptions(), info_command);
  commands.add("build", "Write a scene's database to a file, which stands for the scene from then on", BuildRequest(),
               build_command);
  commands.add("scene", "Write a built-in scene as an NFF file", SceneOptions(), scene_command);
  commands.add("machine", "Print a machine's parameters as JSON, to read or to edit", MachineOptions(), machine_command);
  commands.add("list", "List scenes, machines, policies and other choices", ListOptions(), list_command);
  commands.add("demo", "Render a teapot on eight modelled nodes, and show its page", DemoOptions(), demo_command);
}

}  // namespace dmpc::apps

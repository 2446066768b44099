#include "apps/frontend/machine/machine_command.h"
#include "apps/help/list_command.h"
#include "apps/info/command.h"
#include "apps/program/commands.h"
#include "apps/render/command.h"
#include "apps/scene/scene_command.h"
#include "apps/view/command.h"

namespace dmpc::apps {

void declare_renderer(Commands& commands) {
  commands.add("render", "Render a scene on N nodes", RenderOptions(),
               [](const RenderOptions& options, Interrupt& interrupt, std::ostream& output) {
                 return render_command(options, interrupt, output);
               });
  commands.add("view", "Look round a scene in a browser", ViewOptions(), view_command);
  commands.add("info", "Tell what a scene is, and what a render of it would take", InfoOptions(), info_command);
  commands.add("scene", "Write a built-in scene as an NFF file, or a landscape as glTF", SceneOptions(), scene_command);
  commands.add("machine", "Print a machine's figures as JSON, to read or to start from", MachineOptions(), machine_command);
  commands.add("list", "Tell what scenes, machines, policies and others there are", ListOptions(), list_command);
}

}  // namespace dmpc::apps

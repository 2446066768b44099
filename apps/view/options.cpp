#include "apps/view/options.h"

#include <string>

#include "apps/run/instance_options.h"
#include "apps/run/render_options.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

void add_computer_options(OptionSet& options, ViewOptions& view) {
  options.begin_group("The computer");
  add_nodes_option(options, view.computer.node_count, "8");
  add_strategy_option(options, view.strategy);
  add_system_option(options, view.system);
  add_memory_option(options, view.computer.node_memory_bytes);
  add_options(options, view.database);
  add_instance_option(options, view.database);
}

void add_runner_options(OptionSet& options, ViewOptions& view) {
  options.begin_group("What drives the computer");
  options.add_choice<RunnerKind>(
      "--runner", view.runner.kind,
      {{"threads", RunnerKind::threads}, {"pool", RunnerKind::pool}, {"virtual", RunnerKind::virtual_time}},
      "threads: a thread for each node. pool: a few threads drive all nodes in turn. virtual: the model of a machine");
  options.add_number("--pool-threads", view.computer.pool_threads, 1, nodes::node_count_max, "as many as processors",
                     "Threads that drive all nodes in turn (pool)");
  add_machine_option(options, view.runner.machine_name, " (virtual)");
}

/// The scene is built once, for every camera.
void check_camera_moves(const ViewOptions& view) {
  const std::string why = ", which the camera would take along: dmpc render shows it from one place";
  if (view.picture.staging.fill.value_or(0) > 0) {
    throw UsageError("--fill does not go with view: it is a light in the eye" + why);
  }
  if (view.picture.transport.light_radius) {
    throw UsageError(
        "--light-radius does not go with view: whether a light is a sphere depends on where the eye is; dmpc render " +
        std::string("shows it from one place"));
  }
}

}  // namespace

void add_options(OptionSet options, ViewOptions& view) {
  view.picture.presents_meshes = true;
  add_options(options, view.picture);
  add_transport_options(options, view.picture);
  add_computer_options(options, view);
  add_runner_options(options, view);
  add_page_options(options, view.pages);
  add_ray_options(options, view.rays);
  options.begin_group("The page");
  options.add_number(
      "--port", view.port, 0, 65535, "0",
      "Where on 127.0.0.1 the page is; 0: at any port that is free. From afar ssh -L PORT:127.0.0.1:PORT leads there");
  options.add_flag("--quiet", view.quiet, "No progress, nothing but the address");
  options.check_in_the_end([options, &view] {
    if (view.system) {
      settle_system(options, *view.system, view, view.database);
    }
    settle_database(options, view.strategy, view.database);
    settle_instances(options, {view.system, view.tracer, view.rays.tested_objects}, view.database, view.picture.staging.mesh);
    view.has_several_frames = true;
    check_together(options, view);
    check_runner(options, view.runner.kind);
    check_camera_moves(view);
    choose_pool(view.runner.kind, view.computer);
  });
  options.set_examples(
      "Examples:\n"
      "  dmpc view rings-4-t1\n"
      "  dmpc view teapot-12 --nodes=2 --resolution=800x600 --camera=0,3,2/0,0,0.5/0,0,1/45\n"
      "  dmpc view my.glb --transport=whitted --samples=4 --port=8080\n"
      "The address is said on stderr; whoever has it may turn the camera. While it moves a picture has half the pixels across "
      "and\n"
      "down, and by paths 4 samples a pixel, else one; when it rests all that is asked for, and the page shows the command of "
      "dmpc\n"
      "render that makes the same picture, to the last bit. Ctrl-C ends it, with status 130.");
}

}  // namespace dmpc::apps

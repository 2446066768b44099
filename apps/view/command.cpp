#include "apps/view/command.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/frontend/web/page_server.h"
#include "apps/picture/film_image.h"
#include "apps/render/live_events.h"
#include "apps/run/instance_options.h"
#include "apps/run/render_options.h"
#include "apps/run/warm_nodes.h"
#include "apps/scene/camera_path.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "apps/show/page/live_page.h"
#include "apps/view/render_words.h"
#include "apps/view/wishes.h"
#include "core/base/expect.h"
#include "core/database/conversion.h"
#include "core/picture/film/rounding_loss.h"
#include "core/scene/frame.h"

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
  options.begin_group("Running the computer");
  options.add_choice<RunnerKind>(
      "--runner", view.runner.kind,
      {{"threads", RunnerKind::threads}, {"pool", RunnerKind::pool}, {"virtual", RunnerKind::virtual_time}},
      "threads: one thread per node. pool: a few threads run all nodes in turn. virtual: a model of a machine");
  options.add_number("--pool-threads", view.computer.pool_threads, 1, nodes::node_count_max, "as many as processors",
                     "Threads that run all nodes in turn (pool)");
  add_machine_option(options, view.runner.machine_name, " (virtual)");
}

/// The scene is built once, for every camera.
void check_camera_moves(const ViewOptions& view) {
  const std::string why = ", which would move with it: dmpc render shows it from one place";
  if (view.picture.scene_setup.fill.value_or(0) > 0) {
    throw UsageError("--fill does not go with view: it is a light at the camera" + why);
  }
  if (view.picture.transport.light_radius) {
    throw UsageError(
        "--light-radius does not go with view: whether a light is a sphere depends on where the camera is; dmpc render " +
        std::string("shows it from one place"));
  }
}

/// Pictures are kept and sent whole.
constexpr std::uint32_t pixels_max = std::uint32_t{1} << 22U;
constexpr int moving_samples_by_paths = 4;
/// Interval of progress reports.
constexpr std::chrono::milliseconds report_interval{100};
/// Pictures of a moving camera come as fast as they are made.
constexpr std::chrono::milliseconds look_interval{15};
/// Places of events, all of which a viewer gets at once.
enum : std::size_t { head_place, state_place, picture_place, places };

/// The scene as the shown command sees it, by a camera that stands in place of the file's own: of a mesh the axis of its sky and
/// lights that it has not itself follow from whose camera it is.
core::Scene load(PictureOptions& picture, bool is_quiet) {
  core::Scene scene = load_scene(picture, is_quiet ? LoadNotes::silent : LoadNotes::said);
  picture.resolution = picture.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  const bool is_seen_by_own = !picture.scene_setup.camera;
  picture.scene_setup.camera = camera_of(scene.view);
  return is_seen_by_own && is_mesh(picture.scene) ? load_scene(picture, LoadNotes::silent) : std::move(scene);
}

/// A quarter of the pixels, of few samples.
core::RenderSettings moving_settings(const core::RenderSettings& resting, const core::View& view) {
  core::RenderSettings settings = resting;
  const bool is_by_paths = resting.shade.transport.is_by_paths();
  const int samples = is_by_paths ? std::min(moving_samples_by_paths, resting.camera.samples()) : 1;
  const auto half = [](int side) { return (side + 1) / 2; };
  settings.camera =
      core::Camera(view, resting.header.frame, half(resting.camera.width()), half(resting.camera.height()), samples);
  settings.refinement = {};
  settings.shade.first_samples = static_cast<std::uint32_t>(samples);
  return settings;
}

/// One call of `view`.
class Viewing {
 public:
  Viewing(const ViewOptions& options, Interrupt& interrupt) : options_(options), interrupt_(interrupt) {}

  int run() {
    interrupt_.set_consequence("the page receives no further updates");
    choose_machine(options_);
    load_policy(options_, [this] { interrupt_.check(); });
    server_.emplace(options_.port,
                    PageServer::Service{.option = "--port",
                                        .page = html::live_page("dmpc view " + options_.picture.scene, html::LiveKind::view),
                                        .important = places,
                                        .interval = look_interval,
                                        .takes = {{"camera", [this](const std::string& json) { return wishes_.take(json); }}}});
    std::cerr << "dmpc: to be seen at " + server_->address() + "\n";  // at once
    try {
      build();
      return render(show());
    } catch (const Interrupted&) {
      server_->end(json_of_end("dmpc was asked to stop."));
      throw;
    } catch (const std::exception& error) {
      server_->end(json_of_end("dmpc has failed: " + std::string(error.what()) + "."));
      throw;
    }
  }

 private:
  /// Once; a signal ends the process here and now.
  void build() {
    notify({.said = "The scene is read and built."});
    const Interrupt::EndAtOnce end_at_once(interrupt_);
    core::Scene scene = load(options_.picture, options_.quiet);
    home_ = scene.view;
    check_size();
    const core::Box bounds = core::bounds_of(scene, core::Parallel(0));
    pivot_ = pivot_of(home_, bounds);
    put_eye_far_away(scene, bounds);
    subject_.emplace(build_subject_quietly(std::move(scene), options_.picture, options_.database));
    const core::RenderSettings& built = subject_->settings;
    const core::RenderSettings settings = seen_from(home_, built, subject_->database);
    say({dropped_text(subject_->database.dropped()), loss_text(core::find_rounding_loss(subject_->database, settings.camera)),
         duplicates_text(subject_->database.duplicates()), subject_->gain, subject_->emitters, subject_->kept});
    subject_->database.forget_primitives();
    resting_.emplace(options_, subject_->database, settings);
    moving_.emplace(options_, subject_->database, moving_settings(built, home_));
  }

  void check_size() const {
    const Resolution& size = *options_.picture.resolution;
    const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    if (pixels > pixels_max) {
      throw core::InputError("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                             " is too large for view: expected at most " + grouped(pixels_max) +
                             " pixels: give --resolution=WxH");
    }
  }

  /// Shows what is asked for: at first the scene's own view, roughly, and then as it is. Returns the camera that dmpc render is
  /// to take. Throws Interrupted at a signal.
  CameraChoice show() {
    const core::Camera& camera = resting_->camera();
    server_->feed().put(head_place, "head",
                        json_of(LiveHead{.width = static_cast<std::uint32_t>(camera.width()),
                                         .height = static_cast<std::uint32_t>(camera.height()),
                                         .home = text_of(camera_of(home_)),
                                         .pivot = text_of(pivot_)}));
    show({.camera = camera_of(home_), .is_moving = true});
    show({.camera = camera_of(home_), .is_moving = false});
    std::optional<Wish> wish;
    while ((wish = wishes_.next(interrupt_.token())) && !wish->is_final) {
      show(*wish);
    }
    if (!wish) {
      throw Interrupted{};
    }
    return wish->camera;
  }

  std::vector<std::string> words_with(const CameraChoice& camera, const std::string& picture) const {
    return render_words(own_words(), text_of(camera), *options_.picture.resolution, picture);
  }

  /// "view.png", or "view-2.png", ... where that is there: a key of a browser replaces no file.
  static std::string unused_name() {
    std::string name = "view.png";
    std::error_code none;
    for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(name, none)); ++number) {
      name = "view-" + std::to_string(number) + ".png";
    }
    return name;
  }

  /// Says the command, and becomes it.
  int render(const CameraChoice& camera) {
    std::vector<std::string> words = words_with(camera, unused_name());
    const std::string command = command_text(words);
    server_->end(json_of_end("dmpc renders this picture now, in its own window.", command), {}, interrupt_.token());
    std::cerr << "dmpc: " << command << std::endl;
    std::vector<char*> pointers;
    for (std::string& word : words) {
      pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    ::execv("/proc/self/exe", pointers.data());
    throw core::InputError("dmpc render cannot be started: " + std::string(std::strerror(errno)));
  }

  /// One picture; a whole one goes when another is wished for.
  void show(const Wish& wish) {
    std::stop_source stop;
    const std::stop_callback at_signal(interrupt_.token(), [&stop] { stop.request_stop(); });
    if (!wish.is_moving) {
      wishes_.stop_at_next(stop);
    }
    Stopwatch stopwatch;
    WarmNodes& nodes = wish.is_moving ? *moving_ : *resting_;
    nodes.move_to(view_at(wish.camera, home_));
    const Report report = nodes.render(teller(wish), stop.get_token());
    interrupt_.check();
    if (const Account account = account_of(report); account.end == nodes::RunEnd::finished) {
      notify(wish, account.film, stopwatch.lap());
    }
  }

  nodes::Progress teller(const Wish& wish) {
    if (wish.is_moving) {
      return [](std::uint32_t, std::uint32_t) {};
    }
    return [this, last = std::chrono::steady_clock::now()](std::uint32_t done, std::uint32_t total) mutable {
      if (const auto now = std::chrono::steady_clock::now(); now - last >= report_interval) {
        last = now;
        notify({.said = "Rendering the picture.", .done = done, .total = total});
      }
    };
  }

  void notify(const LiveState& state) { server_->feed().put(state_place, "state", json_of(state)); }

  void notify(const Wish& wish, const core::Film& film, double seconds) {
    LiveShot shot{.whole = {.width = static_cast<std::uint32_t>(film.width()),
                            .height = static_cast<std::uint32_t>(film.height()),
                            .rgb = image_of(film).rgb},
                  .camera = text_of(wish.camera),
                  .is_moving = wish.is_moving,
                  .ms = seconds * 1000};
    if (!wish.is_moving) {
      shot.film = hash_text(film.hash());
      shot.command = command_text(words_with(wish.camera, "view.png"));
    }
    server_->feed().put(picture_place, "picture", json_of(shot));
    const auto pixels = static_cast<std::uint32_t>(film.pixel_count());
    notify({.said = wish.is_moving ? "The camera moves." : "The picture is done.", .done = pixels, .total = pixels});
  }

  void say(const std::vector<std::string>& notes) const {
    if (!options_.quiet) {
      say_notes(notes);
    }
  }

  ViewOptions options_;
  Interrupt& interrupt_;
  core::View home_;  ///< the scene's own, or that of --camera
  core::Vec3d pivot_;
  std::optional<Subject> subject_;
  std::optional<WarmNodes> resting_, moving_;
  Wishes wishes_;
  std::optional<PageServer> server_;  ///< ends before what its threads use
};

}  // namespace

void add_options(OptionSet options, ViewOptions& view) {
  view.picture.presents_meshes = true;
  add_options(options, view.picture);
  add_transport_options(options, view.picture);
  add_computer_options(options, view);
  add_runner_options(options, view);
  add_page_options(options, view);
  add_ray_options(options, view.rays);
  options.begin_group("The page");
  options.add_number("--port", view.port, 0, 65535, "0",
                     "Port of the page on 127.0.0.1; 0: any free port. From another computer use ssh -L PORT:127.0.0.1:PORT");
  options.add_flag("--quiet", view.quiet, "Print no progress, only the address");
  options.check_in_the_end([options, &view] {
    if (view.system) {
      settle_system(options, *view.system, view, view.database);
    }
    settle_database(options, view.strategy, view.database);
    settle_instances(options, {view.system, view.tracer, view.rays.tested_objects}, view.database, view.picture.scene_setup.mesh);
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
      "The address is printed on stderr; everyone who knows it can move the camera. While the camera moves, a picture has half\n"
      "the pixels across and down, and 4 samples per pixel by paths, otherwise one. When it rests, the picture has all that was\n"
      "asked for, and the page shows the dmpc render command that makes the same picture, to the last bit. The key R, or the\n"
      "button Render, ends the view and runs that command, which writes view.png, or view-2.png\n"
      "and so on where that is there. Ctrl-C ends it with status 130.");
}

int view_command(const ViewOptions& options, Interrupt& interrupt, std::ostream& /*output*/) {
  return Viewing(options, interrupt).run();
}

}  // namespace dmpc::apps

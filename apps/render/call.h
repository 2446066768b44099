// The state of one call of `render`, from its beginning to its end.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "apps/frontend/system/file_lock.h"
#include "apps/frontend/system/files.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/render/checkpoints.h"
#include "apps/render/frame_files.h"
#include "apps/render/frame_scenes.h"
#include "apps/render/live_view.h"
#include "apps/render/pass_progress.h"
#include "apps/run/render_options.h"
#include "nodes/ranks/heartbeats.h"

namespace dmpc::apps {

/// With ranks, rank 0's.
struct RenderCall {
  /// Chooses the machine and loads the policy. Throws as choose_machine(), load_policy() and FrameScenes do.
  RenderCall(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files);
  RenderCall(const RenderCall&) = delete;
  RenderCall& operator=(const RenderCall&) = delete;

  /// Prints the notes that are not empty, unless quiet.
  void say(const std::vector<std::string>& notes) const;
  /// Prints the notes that are not empty and have not been printed for an earlier frame.
  void report_once(const std::vector<std::string>& notes);
  /// Sets what an interruption means while a picture is rendered.
  void set_consequence();

  /// Calls `work`, which does not communicate, while heartbeats go to the other ranks, if there are any.
  template <class Work>
  std::invoke_result_t<const Work&> apart(const Work& work) const {
    return asked.computer.ranks == nullptr ? work() : nodes::with_heartbeats(*asked.computer.ranks, work);
  }

  const RenderOptions asked;  ///< with names for all frames
  Interrupt& interrupt;
  std::ostream& output;
  Files& files;
  FrameScenes scenes{asked};
  std::optional<FileLock> lock;    ///< on the checkpoint
  std::unique_ptr<LiveView> live;  ///< outlives everything that it observes
  std::optional<Checkpoints> checkpoints;
  std::optional<PassProgress> passes;  ///< while a picture is rendered
  std::set<std::string> reported;      ///< notes printed so far
};

/// Acquires everything that does not depend on the scene: paths, libraries, the checkpoint's lock, the port for browsers. Throws
/// core::UsageError or core::InputError if one is not available.
void claim(RenderCall& call, const DueFrame& first);

}  // namespace dmpc::apps

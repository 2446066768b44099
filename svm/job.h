// What a rank without the host is told of a run before it has pages: all but the scene.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/picture/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "nodes/ranks/rank_links.h"
#include "svm/plan.h"

namespace dmpc::svm {

/// A plan, and what its nodes are made of beside pages. Not copied: the plan refers to the start.
struct Job {
  Plan plan;
  core::RenderSettings settings;
  std::optional<core::PartialPicture> start;  ///< where the picture is begun, without its light, which is the host's
  bool are_frames = false;                    ///< others may follow it on the same nodes

  Job(const Plan& of, const core::RenderSettings& rendered) : plan(of), settings(rendered) {}
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
};

/// As bytes.
std::string job_bytes(const Plan& plan, const core::RenderSettings& settings, bool are_frames);
/// From these, on a rank that knows these strategies, which makes the plan anew and expects it to be the same.
std::unique_ptr<Job> job_from(std::string_view bytes, nodes::RankLinks& ranks, const Strategies& strategies);

}  // namespace dmpc::svm

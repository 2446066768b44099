#include "nodes/pictures/computer.h"

#include "core/base/expect.h"
#include "nodes/ranks/repeated_runs.h"

namespace dmpc::pictures {

void begin_frame(nodes::Runner& runner, std::uint32_t node_count, const core::RenderSettings& settings) {
  for (std::uint32_t i = 0; i < node_count; ++i) {
    if (runner.is_here(i)) {
      dynamic_cast<PictureProgram&>(runner.program(i)).begin_frame(settings);
    }
  }
}

Computer::Computer(core::Film film, const Specify& specify, const nodes::ComputerRequest& computer,
                   const nodes::Watching& watching)
    : film_(std::move(film)), ranks_(computer.ranks), add_seen_(watching.elsewhere.adds()) {
  core::expect(watching.heat == nullptr || watching.heat->item_count() == film_.pixel_count(),
               "a heat map is of the picture's size");
  const std::vector<nodes::NodeSpecification> specifications = specify(film_);
  node_count_ = static_cast<std::uint32_t>(specifications.size() - 1);
  runner_ = nodes::make_runner(specifications, computer, watching.observer);
}

void Computer::begin_frame(core::Film film, const core::RenderSettings& settings, const core::FineDetail* detail) {
  film_ = std::move(film);
  pictures::begin_frame(*runner_, node_count_, settings);
  host().begin_frame(detail);
  if (ranks_ != nullptr) {
    nodes::hand_out_again(settings, *ranks_);
  }
}

}  // namespace dmpc::pictures

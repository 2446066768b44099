#include "apps/view/warm_nodes.h"

#include <cstdint>

#include "core/picture/frame_settings.h"

namespace dmpc::apps {

std::optional<Report> WarmNodes::render(const core::View& view, const nodes::Progress& progress, const std::stop_token& stop) {
  const core::Camera& own = settings_.camera;
  settings_ =
      core::seen_by(core::Camera(view, settings_.header.frame, own.width(), own.height(), own.samples()), settings_, database_);
  Report report = run(progress, stop);
  if (account_of(report).end != nodes::RunEnd::finished) {
    ready_.reset();
    return std::nullopt;
  }
  return report;
}

Report WarmNodes::run(const nodes::Progress& progress, const std::stop_token& stop) {
  progress_ = progress;
  if (ready_) {
    return ready_->go_on(settings_, stop);
  }
  ready_ = make_ready(options_, database_, settings_, stop);
  return ready_->start([this](std::uint32_t done, std::uint32_t total) { progress_(done, total); }, stop);
}

}  // namespace dmpc::apps

#include "apps/run/warm_nodes.h"

#include <cstdint>
#include <utility>

#include "core/picture/camera/frame_settings.h"

namespace dmpc::apps {

core::RenderSettings seen_from(const core::View& view, const core::RenderSettings& settings, const core::Database& database) {
  const core::Camera& own = settings.camera;
  return core::seen_by(core::Camera(view, settings.header.frame, own.width(), own.height(), own.samples()), settings, database);
}

std::vector<std::string> WarmNodes::plan(const nodes::Watching& watching, const core::Continuation& continuation,
                                         const std::stop_token& stop) {
  ready_ = make_ready(options_, database_, settings_, stop, watching, continuation);
  is_started_ = false;
  return ready_->notes;
}

Report WarmNodes::render(const nodes::Progress& progress, const std::stop_token& stop) {
  progress_ = progress;
  if (!ready_) {
    plan({}, {}, stop);
  }
  Report report = std::exchange(is_started_, true)
                      ? ready_->go_on(settings_, stop)
                      : ready_->start([this](std::uint32_t done, std::uint32_t total) { progress_(done, total); }, stop);
  if (account_of(report).end != nodes::RunEnd::finished) {
    ready_.reset();
  }
  return report;
}

}  // namespace dmpc::apps

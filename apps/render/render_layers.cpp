#include <cstdint>
#include <utility>

#include "apps/render/stages.h"
#include "apps/run/layer_options.h"
#include "core/base/expect.h"
#include "core/picture/camera/layer_settings.h"

namespace dmpc::apps {

namespace {

/// For one picture that nobody observes, without other ranks.
StrategyOptions unobserved(const StrategyOptions& options) {
  StrategyOptions alone = options;
  alone.has_several_frames = false;
  alone.computer.ranks = nullptr;
  alone.pages.count_pages = false;
  alone.pages.record_references = false;
  alone.pages.reference_logs = nullptr;
  return alone;
}

}  // namespace

void render_layers(const RenderCall& call, PlannedPicture& planned) {
  if (planned.done) {
    return;  // it has those of the frame that it equals
  }
  planned.layers.clear();
  const StrategyOptions options = unobserved(planned.options);
  for (const core::Layer layer : layers_of(planned.options.layers)) {
    WarmNodes nodes(options, planned.built.subject.database, core::layer_settings(layer, planned.nodes.settings()));
    const Report report = nodes.render([](std::uint32_t, std::uint32_t) {}, call.interrupt.token());
    const Account account = account_of(report);
    call.interrupt.check();
    core::expect(account.end == nodes::RunEnd::finished, "a run that nobody stopped is finished");
    planned.layers.push_back(layer_image(layer, account.film));
  }
}

}  // namespace dmpc::apps

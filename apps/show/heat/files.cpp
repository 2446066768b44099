#include "apps/show/heat/files.h"

#include <string>

#include "apps/picture/image_file.h"
#include "apps/run/heat_options.h"
#include "apps/run/render_record.h"
#include "apps/show/heat/field.h"
#include "apps/show/heat/picture.h"

namespace dmpc::apps {

namespace {

Channel channel_of(const HeatField& field, const RenderRecord& record) {
  Channel channel{.width = field.width, .height = field.height, .name = std::string(core::name_of(field.kind))};
  channel.values.assign(field.values.begin(), field.values.end());
  channel.remarks = {{"dmpc:meaning", field.meaning},
                     {"dmpc:unit", field.unit},
                     {"dmpc:scene", record.options.picture.scene},
                     {"dmpc:strategy", name_of(record.options.strategy)},
                     {"dmpc:nodes", std::to_string(record.options.computer.node_count)},
                     {"dmpc:runner", name_of(record.options.runner.kind)},
                     {"dmpc:repeatable", field.is_repeatable ? "yes" : "no"}};
  if (!field.clock.empty()) {
    channel.remarks.push_back({"dmpc:clock", field.clock});
  }
  return channel;
}

}  // namespace

std::string heat_file(const HeatRequest& request, const RenderRecord& record) {
  const HeatField field = heat_field(request.kind, record);
  return holds_numbers(request)
             ? encoded_picture(request.path, channel_of(field, record))
             : encoded_picture(request.path, heat_picture(field, record.options.picture.scene + ", " + computer_text(record)));
}

}  // namespace dmpc::apps

#include "dataflow/film_gather.h"

#include <algorithm>

#include "core/base/expect.h"
#include "dataflow/rays/pixel_order.h"

namespace dmpc::dataflow {

FilmGather::FilmGather(nodes::Node& node, std::uint32_t node_count, std::uint32_t credits, std::uint32_t at_once)
    : node_(&node), host_(nodes::NodeId{node_count}), room_(layout().in(node.memory()).data()), at_once_(at_once) {
  core::expect(at_once >= 1 && at_once <= entries_at_once_max, "what may come at once has room in a packet");
  node.grant(host_, film_channel, credits);
}

void FilmGather::add(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  core::expect(count_ < film_packet_entries, "no light is gathered while a film packet waits");
  ++counters_.deposits;
  if (FilmEntry* const entry = find(pixel, plane)) {
    counters_.saturated += core::add(entry->light, light) ? 1 : 0;
    return;
  }
  append(pixel, plane, light);
}

void FilmGather::add_only(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  core::expect(count_ < film_packet_entries, "no light is gathered while a film packet waits");
  ++counters_.deposits;
  if (FilmEntry* const before = entry_before(pixel, plane, light)) {
    ++before->more;
  } else {
    append(pixel, plane, light);
  }
}

/// Among the newest, one for each row of a square: the entry that ends before this pixel and has the same light, or nullptr.
FilmEntry* FilmGather::entry_before(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  for (std::uint32_t i = 1; i <= std::min(count_, PixelOrder::side); ++i) {
    FilmEntry& entry = room_->entries[count_ - i];
    if (pixel == entry.pixel + entry.more + 1 && entry.plane == plane && entry.light == light &&
        entry.more + 1U < film_entry_pixels_max) {
      return &entry;
    }
  }
  return nullptr;
}

void FilmGather::append(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  room_->entries[count_++] = {pixel, static_cast<std::uint16_t>(plane), 0, light};
  if (waits()) {
    flush();
  }
}

FilmEntry* FilmGather::find(std::uint32_t pixel, std::uint32_t plane) {
  for (std::uint32_t i = count_; i > 0; --i) {
    FilmEntry& entry = room_->entries[i - 1];
    if (entry.pixel == pixel && entry.plane == plane && entry.more == 0) {
      return &entry;
    }
  }
  return nullptr;
}

void FilmGather::flush() {
  if (count_ == 0 || node_->credits(host_, film_channel) == 0) {
    return;
  }
  room_->header.count = count_;
  const auto packet = std::as_bytes(std::span(room_, 1)).first(film_packet_bytes(count_));
  node_->send_reserved(host_, film_channel, number_of(Kind::film), packet);
  counters_.entries += count_;
  count_ = 0;
  ++under_way_;
}

void FilmGather::acknowledged() {
  core::expect(under_way_ > 0, "the host acknowledges what was sent");
  --under_way_;
  node_->grant(host_, film_channel);
  if (waits()) {
    flush();
  }
}

}  // namespace dmpc::dataflow

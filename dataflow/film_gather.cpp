#include "dataflow/film_gather.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "core/base/expect.h"
#include "dataflow/rays/pixel_order.h"

namespace dmpc::dataflow {

FilmGather::FilmGather(nodes::Node& node, const Capacity& capacity)
    : node_(&node),
      host_(nodes::NodeId{capacity.node_count}),
      packet_(layout(capacity.packet_entries).in(node.memory())),
      entries_(std::launder(reinterpret_cast<FilmEntry*>(packet_.data() + film_packet_bytes(0))), capacity.packet_entries),
      at_once_(capacity.at_once) {
  core::expect(at_once_ >= 1 && at_once_ <= capacity.packet_entries, "what may come at once has room in a packet");
  node.grant(host_, film_channel, capacity.credits);
}

void FilmGather::add(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  core::expect(count_ < entries_.size(), "no light is gathered while a film packet waits");
  ++counters_.deposits;
  if (FilmEntry* const entry = find(pixel, plane)) {
    counters_.saturated += core::add(entry->light, light) ? 1 : 0;
    return;
  }
  append(pixel, plane, light);
}

void FilmGather::add_only(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  core::expect(count_ < entries_.size(), "no light is gathered while a film packet waits");
  ++counters_.deposits;
  if (FilmEntry* const before = entry_before(pixel, plane, light)) {
    ++before->more;
  } else {
    append(pixel, plane, light);
  }
}

/// The entry that ends before this pixel and has the same light, of the newest, one for each row of a square; or nullptr.
FilmEntry* FilmGather::entry_before(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  for (std::uint32_t i = 1; i <= std::min(count_, PixelOrder::side); ++i) {
    FilmEntry& entry = entries_[count_ - i];
    if (pixel == entry.pixel + entry.more + 1 && entry.plane == plane && entry.light == light &&
        entry.more + 1U < film_entry_pixels_max) {
      return &entry;
    }
  }
  return nullptr;
}

void FilmGather::append(std::uint32_t pixel, std::uint32_t plane, const core::FixedColor& light) {
  entries_[count_++] = {pixel, static_cast<std::uint16_t>(plane), 0, light};
  if (waits()) {
    flush();
  }
}

FilmEntry* FilmGather::find(std::uint32_t pixel, std::uint32_t plane) {
  for (std::uint32_t i = 1; i <= std::min(count_, newest_entries); ++i) {
    FilmEntry& entry = entries_[count_ - i];
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
  const FilmHeader header{.count = count_};
  std::memcpy(packet_.data(), &header, sizeof(header));
  node_->send_reserved(host_, film_channel, number_of(Kind::film), packet_.first(film_packet_bytes(count_)));
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

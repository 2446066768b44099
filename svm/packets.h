// Messages between nodes and the host about pixels, for all strategies here: values, without pointers.
//
//   kind                   from -> to          channel   size   its slot in the target's mailbox is reserved by
//   work_request           node -> next node   ring      small  its requester: one in flight for each node
//   work_reply             donor -> requester  control   small  the work request
//   film_sums              node -> host        bulk      bulk   the sender's film credits
//   film_acknowledgement   host -> node        control   small  the film packet
//   done                   node -> host        control   small  once a pass
//   stop                   host -> node        control   small  once a run
//   mask_part              host -> node        bulk      bulk   the host's credit for that node
//   mask_acknowledgement   node -> host        control   small  the part of the mask
//   begin_pass             host -> node        control   small  once a pass, when all nodes are done with the one before
//
// Work requests go to the host if it assigns the items. Masks and passes exist only if the picture is refined: when all nodes are
// done with a pass, each gets the mask of its share, which has the additional samples of each pixel, part by part, and when all
// nodes have theirs the pass begins.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "core/base/expect.h"
#include "core/picture/film/film.h"
#include "core/picture/sampling/sample_pass.h"
#include "nodes/packet.h"
#include "svm/pages/packets.h"
#include "svm/work_items.h"

namespace dmpc::svm {

/// The node `requester` has no pixels left. Hops from node to node along the ring until one answers or `visits_left` have been
/// asked or skipped.
struct WorkRequest {
  std::uint32_t requester = 0;
  std::uint32_t visits_left = 0;
  std::uint32_t pass = 0;  ///< the requester's, from 0 on
};
static_assert(is_small_packet<WorkRequest>);

/// A work item in a packet, in 16 bytes: items and steps are smaller than pictures.
struct SentItem {
  std::uint32_t x = 0, y = 0;
  std::uint16_t width = 0, height = 0, step_x = 1, step_y = 1;

  SentItem() = default;
  explicit SentItem(const PixelRectangle& item)
      : x(item.x),
        y(item.y),
        width(narrowed(item.width)),
        height(narrowed(item.height)),
        step_x(narrowed(item.step_x)),
        step_y(narrowed(item.step_y)) {}
  constexpr PixelRectangle rectangle() const { return {x, y, width, height, step_x, step_y}; }

 private:
  static std::uint16_t narrowed(std::uint32_t value) {
    core::expect(value < 65536, "an item's sides and steps are below 65536 pixels");
    return static_cast<std::uint16_t>(value);
  }
};

/// An item of `donor`'s share; an empty one means that the request has been all round the ring: there is no more work.
struct WorkReply {
  SentItem item;
  std::uint32_t donor = 0;
};
static_assert(is_small_packet<WorkReply>);

/// The answer to a work request if passes leave pixels out.
struct MaskedWorkReply {
  WorkReply reply;
  ItemSteps steps;  ///< samples of the item's pixels in this pass
};
static_assert(is_small_packet<MaskedWorkReply>);

/// Consecutive pixels with the same light, with all samples of the pass: usually one, or many of the background. Each pixel is
/// sent once per pass.
struct FilmEntry {
  std::uint32_t pixel = 0;  ///< the first
  std::uint32_t more = 0;   ///< number of pixels that follow it, by index
  core::PixelSums sums;     ///< each pixel's; on as many planes as are sent
};
static_assert(sizeof(FilmEntry) == 56 && std::is_trivially_copyable_v<FilmEntry>);

/// The size of an entry in a packet: the first bytes of a FilmEntry, up to its last plane.
constexpr std::size_t film_entry_bytes(std::uint32_t planes) {
  return offsetof(FilmEntry, sums) + planes * sizeof(core::FixedColor);
}
static_assert(film_entry_bytes(1) == 32 && film_entry_bytes(2) == sizeof(FilmEntry));

/// Precedes `count` entries.
struct FilmHeader {
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
};
static_assert(sizeof(FilmHeader) == 8 && std::is_trivially_copyable_v<FilmHeader>);

/// The offset of entry `place` in a packet of film, whose entries have `planes` planes.
constexpr std::size_t film_entry_offset(std::size_t place, std::uint32_t planes) {
  return sizeof(FilmHeader) + place * film_entry_bytes(planes);
}
/// The size of a packet of entries: never so little that it would be small, since its slot is a bulk one.
constexpr std::size_t film_packet_bytes(std::size_t entries, std::uint32_t planes) {
  return std::max(film_entry_offset(entries, planes), nodes::small_payload_bytes + 8);
}
static_assert(film_packet_bytes(1, 2) == film_entry_offset(1, 2), "with two planes no packet is filled up");

/// The entry at `place` of such a packet.
inline FilmEntry film_entry_in(std::span<const std::byte> packet, std::size_t place, std::uint32_t planes) {
  FilmEntry entry;
  std::memcpy(&entry, packet.data() + film_entry_offset(place, planes), film_entry_bytes(planes));
  return entry;
}
/// Stores the entry there.
inline void put_film_entry(std::span<std::byte> packet, std::size_t place, std::uint32_t planes, const FilmEntry& entry) {
  std::memcpy(packet.data() + film_entry_offset(place, planes), &entry, film_entry_bytes(planes));
}

struct FilmAcknowledgement {
  std::uint32_t count = 0;  ///< entries received
};
static_assert(is_small_packet<FilmAcknowledgement>);

/// The sender has no pixels left, knows of none elsewhere, and everything that it sent has been acknowledged. It still serves
/// pages.
struct Done {
  std::uint64_t pixels_rendered = 0;  ///< in this pass
};
static_assert(is_small_packet<Done>);

/// The samples of pixels of the target's share, row by row, in the next pass.
struct MaskPart {
  std::uint32_t first_pixel = 0;
  std::uint32_t padding = 0;
  std::array<core::SampleStep, 480> steps{};  ///< steps beyond the share add none
};
static_assert(std::is_trivially_copyable_v<MaskPart> && sizeof(MaskPart) > nodes::small_payload_bytes, "every part is bulk");

struct MaskAcknowledgement {
  std::uint32_t padding = 0;
};
static_assert(is_small_packet<MaskAcknowledgement>);

/// Every node has its part of the mask: render the samples that it has.
struct BeginPass {
  std::uint32_t padding = 0;
};
static_assert(is_small_packet<BeginPass>);

/// Every node is done and the film is complete.
struct Stop {
  std::uint32_t pixels_total = 0;
};
static_assert(is_small_packet<Stop>);

}  // namespace dmpc::svm

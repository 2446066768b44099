// Messages between the nodes of dataflow and the host: values, without pointers.
//
//   kind                   from -> to            channel   size   its slot in the target's mailbox is reserved by
//   rays                   node -> owner         rays      bulk   the sender's ray credits for that owner
//   overflow               node -> host          rays      bulk   the sender's ray credits for the host
//   overflow_taken         host -> node          control   small  the packet of overflow whose credit it gives back
//   forwarded              host -> owner         rays      bulk   the host's ray credits for that owner
//   credits                receiver -> sender    control   small  the ray packets whose credits it gives back, or the request
//   ask                    node -> owner         control   small  itself: the next waits for the grant
//   unused                 node -> owner         rays      bulk   the credit that it gives back
//   film                   node -> host          film      bulk   the sender's film credits
//   film_acknowledgement   host -> node          control   small  the film packet
//   token                  parent <-> child      control   small  the token before: calls and what is told take turns
//   finish                 parent -> child       control   small  once a run
//   done                   child -> parent       control   small  the child's last token; once a run
//   stop                   parent -> child       control   small  once a run
//   primaries              host -> node          film      bulk   the host's credits for dealing to that node
//   primaries_taken        node -> host          control   small  the packet of primaries whose credit it gives back
//   unit_ask               node -> node          control   small  itself: a node asks one at a time
//   unit_refusal           node -> requester         control   small  the question
//   unit_page              donor -> requester        units     bulk   the question, then the acknowledgement of the page before
//   unit_primaries         donor -> requester        units     bulk   the acknowledgement of the last page, or of the one before
//   unit_acknowledgement   recipient -> donor        control   small  the page, or the primary rays
//   unit_moved             receiver -> sender    control   small  the ray packets whose credits are given back with it
//
// Requests and unused credits exist only if owners' slots are shared (flow_control.h). An unused credit counts as a packet of
// rays for termination detection, so none is in flight then. Packets of units exist only if regions move.
//
// Primaries exist only if the host assigns primary rays after the start (PlanRequest::is_assigned()): those of later passes, and
// those of the first in a run that is saved or resumed. A packet of them counts as one of rays for termination detection. Finish
// and done then come once per pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "core/base/units.h"
#include "core/picture/film/film.h"
#include "core/picture/sampling/refinement.h"
#include "core/record/ray.h"
#include "core/trace/cursor.h"
#include "dataflow/rays/tested_objects.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/regions/primary_run.h"
#include "dataflow/termination.h"
#include "nodes/node.h"
#include "nodes/packet.h"
#include "nodes/pictures/host.h"

namespace dmpc::dataflow {

using core::operator""_KiB;

enum class Kind : nodes::PacketKind {
  rays,
  overflow,
  overflow_taken,
  forwarded,
  credits,
  film,
  film_acknowledgement,
  token,
  finish,
  done,
  stop,
  primaries,
  primaries_taken,
  ask,
  unused,
  unit_ask,
  unit_refusal,
  unit_page,
  unit_primaries,
  unit_acknowledgement,
  unit_moved
};
constexpr nodes::PacketKind number_of(Kind kind) { return static_cast<nodes::PacketKind>(kind); }
static_assert(number_of(Kind::unit_moved) < nodes::packet_kind_count);
inline constexpr std::array<const char*, 21> kind_names = {"rays",
                                                           "overflow",
                                                           "overflow_taken",
                                                           "forwarded",
                                                           "credits",
                                                           "film",
                                                           "film_acknowledgement",
                                                           "token",
                                                           "finish",
                                                           "done",
                                                           "stop",
                                                           "primaries",
                                                           "primaries_taken",
                                                           "ask",
                                                           "unused",
                                                           "unit_ask",
                                                           "unit_refusal",
                                                           "unit_page",
                                                           "unit_primaries",
                                                           "unit_acknowledgement",
                                                           "unit_moved"};
/// The packet's name, for reports.
constexpr const char* name_of(Kind kind) { return kind_names[number_of(kind)]; }

inline constexpr nodes::Channel ray_channel = 0;
inline constexpr nodes::Channel film_channel = 1;
inline constexpr nodes::Channel control_channel = 2;
inline constexpr nodes::Channel unit_channel = 3;
static_assert(unit_channel < nodes::channel_count);

/// The default length of a packet of rays on a modelled machine; on threads it is more.
inline constexpr std::size_t packet_bytes = 1_KiB;
/// No packet is longer.
inline constexpr std::size_t packet_bytes_max = 64_KiB;

/// A ray that goes from region to region.
struct RayMessage {
  core::Ray ray;
  double t_enter = 0;
  core::Corner cell{};  ///< the finest cell that it enters; its owner is the target
  std::uint8_t entry_axis = 3;
  /// 1: `best` is the hit, known to be the nearest; the target is its finder, which alone has its leaf and shades it.
  std::uint8_t is_confirmed = 0;
  /// Index of the node in whose memory best.leaf is; meaningless if there is no candidate.
  std::uint16_t finder = 0;
  core::Hit best;
  TestedNames tested{};  ///< as many are sent as the run has asked for: usually none

  core::Passage passage() const { return {t_enter, cell, entry_axis, best}; }
};
static_assert(sizeof(RayMessage) == 152 && std::is_trivially_copyable_v<RayMessage>);

/// The size of a message in packets and queues: the first bytes of a RayMessage.
constexpr std::size_t ray_message_bytes(std::uint32_t tested_objects) {
  return offsetof(RayMessage, tested) + tested_objects * sizeof(std::uint32_t);
}
static_assert(ray_message_bytes(0) == 120 && ray_message_bytes(tested_objects_max) == sizeof(RayMessage));
static_assert(region_count_max <= 0x10000, "a finder's index fits a message");

/// A fresh ray, or one that leaves a region.
inline RayMessage message_of(const core::Ray& ray, const core::Passage& passage, nodes::NodeId finder) {
  return {.ray = ray,
          .t_enter = passage.t_enter,
          .cell = passage.cell,
          .entry_axis = passage.entry_axis,
          .finder = static_cast<std::uint16_t>(nodes::index_of(finder)),
          .best = passage.best};
}

/// Precedes `count` rays.
struct RayPacketHeader {
  std::uint16_t count = 0;
  std::uint16_t owner = 0;      ///< target of the rays, by either way
  std::uint32_t rays_left = 0;  ///< if regions move: primary rays of the sender's units that have not started
};
static_assert(sizeof(RayPacketHeader) == 8 && std::is_trivially_copyable_v<RayPacketHeader>);

/// The size of a packet of `ray_count` rays, in bytes.
constexpr std::size_t ray_packet_bytes(std::size_t ray_count, std::uint32_t tested_objects = 0) {
  return sizeof(RayPacketHeader) + ray_count * ray_message_bytes(tested_objects);
}
static_assert(ray_packet_bytes(1) > nodes::small_payload_bytes, "every packet of rays is bulk");
/// Copies a message, as it is sent. Mostly rays have no names with them, and then the compiler knows the length.
inline void copy_message(void* to, const void* from, std::size_t message_bytes) {
  if (message_bytes == ray_message_bytes(0)) {
    std::memcpy(to, from, ray_message_bytes(0));
  } else {
    std::memcpy(to, from, message_bytes);
  }
}
/// The bytes of the ray at `place` of such a packet, whose rays have `tested_objects` names.
inline std::span<const std::byte> ray_bytes_in(std::span<const std::byte> packet, std::size_t place,
                                               std::uint32_t tested_objects) {
  return packet.subspan(ray_packet_bytes(place, tested_objects), ray_message_bytes(tested_objects));
}
/// Reads a message.
inline RayMessage message_in(std::span<const std::byte> bytes) {
  RayMessage message;
  copy_message(&message, bytes.data(), bytes.size());
  return message;
}
inline RayMessage ray_in(std::span<const std::byte> packet, std::size_t place, std::uint32_t tested_objects) {
  return message_in(ray_bytes_in(packet, place, tested_objects));
}
inline std::span<std::byte> ray_bytes_in(std::span<std::byte> packet, std::size_t place, std::uint32_t tested_objects) {
  return packet.subspan(ray_packet_bytes(place, tested_objects), ray_message_bytes(tested_objects));
}
/// Stores it there.
inline void put_ray(std::span<std::byte> packet, std::size_t place, std::uint32_t tested_objects, const RayMessage& message) {
  copy_message(ray_bytes_in(packet, place, tested_objects).data(), &message, ray_message_bytes(tested_objects));
}
/// Reads the value at `offset` bytes from the beginning of a message; and writes it.
template <class T>
void get_field(std::span<const std::byte> message, std::size_t offset, T& field) {
  std::memcpy(&field, message.subspan(offset, sizeof(T)).data(), sizeof(T));
}
template <class T>
void put_field(std::span<std::byte> message, std::size_t offset, const T& field) {
  std::memcpy(message.subspan(offset, sizeof(T)).data(), &field, sizeof(T));
}
/// Members of a message, read in place.
inline core::RayKind kind_in(std::span<const std::byte> message) {
  return static_cast<core::RayKind>(message[offsetof(RayMessage, ray) + offsetof(core::Ray, kind)]);
}
inline std::uint8_t depth_in(std::span<const std::byte> message) {
  return static_cast<std::uint8_t>(message[offsetof(RayMessage, ray) + offsetof(core::Ray, depth)]);
}
inline std::uint32_t pixel_in(std::span<const std::byte> message) {
  std::uint32_t pixel = 0;
  get_field(message, offsetof(RayMessage, ray) + offsetof(core::Ray, pixel), pixel);
  return pixel;
}
inline bool is_confirmed_in(std::span<const std::byte> message) {
  return message[offsetof(RayMessage, is_confirmed)] != std::byte{0};
}
/// The number of rays that fit `bytes`.
constexpr std::uint32_t rays_in(std::size_t bytes, std::uint32_t tested_objects = 0) {
  return static_cast<std::uint32_t>((bytes - sizeof(RayPacketHeader)) / ray_message_bytes(tested_objects));
}
inline constexpr std::uint32_t ray_batch_max = rays_in(packet_bytes_max);

/// A packet whose only content is its kind.
struct Word {
  std::uint32_t padding = 0;
};

/// The receiver has taken the rays of some packets.
struct Credits {
  std::uint32_t count = 0;
};

/// The host has taken a packet of rays that overflowed.
struct OverflowTaken {
  std::uint32_t host_rays = 0;  ///< that it buffers now, for all nodes (flow_control.h)
};

/// Asks an owner for one of its shared slots; the answer is a credit.
using Ask = Word;

/// Returns a credit that is no longer needed, in the slot that it stands for: so long that it takes a slot of packets of rays.
struct Unused {
  std::array<std::byte, nodes::small_payload_bytes + 8> padding{};
};
static_assert(sizeof(Unused) > nodes::small_payload_bytes && sizeof(Unused) <= ray_packet_bytes(1));

/// Light for a plane of a pixel: the sum of one or more deposits. A pixel's come from any number of nodes. Or for each of several
/// background pixels.
struct FilmEntry {
  std::uint32_t pixel = 0;  ///< the first
  std::uint16_t plane = 0;
  std::uint16_t more = 0;  ///< number of pixels that follow it, by index
  core::FixedColor light;  ///< each pixel's
};
/// The maximum number of pixels of an entry.
inline constexpr std::uint32_t film_entry_pixels_max = 0x10000;
static_assert(sizeof(FilmEntry) == 32 && std::is_trivially_copyable_v<FilmEntry>);

/// Precedes `count` entries.
struct FilmHeader {
  std::uint32_t count = 0;
  std::uint32_t padding = 0;
};
static_assert(sizeof(FilmHeader) == 8 && std::is_trivially_copyable_v<FilmHeader>);

constexpr std::size_t film_packet_bytes(std::size_t entry_count) { return sizeof(FilmHeader) + entry_count * sizeof(FilmEntry); }
/// The number of entries that fit `bytes`.
constexpr std::uint32_t film_entries_in(std::size_t bytes) {
  return static_cast<std::uint32_t>((bytes - sizeof(FilmHeader)) / sizeof(FilmEntry));
}
/// The capacity of a packet of film.
inline constexpr std::uint32_t film_packet_entries = film_entries_in(pictures::film_packet_bytes_max);

struct FilmAcknowledgement {
  std::uint32_t count = 0;  ///< entries received
};

/// No ray is left anywhere: send the rest of the film.
using Finish = Word;

/// Everything that the sender, and those below it in the tree, put on the film has been acknowledged.
struct Done {
  std::uint64_t entries = 0;  ///< since the start
};

/// The reports of a member's children in the tree since the end was detected.
struct DoneBelow {
  std::uint32_t reported = 0;
  std::uint64_t entries = 0;

  void add(const Done& done) {
    ++reported;
    entries += done.entries;
  }
};

/// Primary rays of a pass that enter the grid in the target's region.
struct AssignedPrimaries {
  core::SampleRange samples;
  std::uint32_t count = 0;  ///< number of runs
  std::uint32_t padding = 0;
  std::array<PrimaryRun, 60> runs{};  ///< numbered by `samples`
};
static_assert(std::is_trivially_copyable_v<AssignedPrimaries> && sizeof(AssignedPrimaries) > nodes::small_payload_bytes);
/// The maximum number of such packets at a node: one is processed while the next is in flight.
inline constexpr std::uint32_t assigned_packets = 2;

/// The sender has slots for some more packets of primaries.
struct PrimariesTaken {
  std::uint32_t count = 0;
};

/// The sender is idle, and has memory for this number of pages, and of runs of primary rays.
struct UnitAsk {
  std::uint32_t free_frames = 0, free_runs = 0;
};

using UnitRefusal = Word;

/// Precedes a page that a unit's rays need.
struct UnitPageHeader {
  std::uint32_t unit = 0, version = 0;
  std::uint32_t page = 0;     ///< its number in the database
  std::uint32_t is_last = 0;  ///< 1: the receiver is responsible for the unit from now on
};
static_assert(std::is_trivially_copyable_v<UnitPageHeader>);

/// Primary rays that enter the grid in a unit for which the receiver is responsible.
struct UnitPrimaryRays {
  std::uint32_t unit = 0;
  std::uint32_t is_last = 0;  ///< 1: nothing more of the unit follows
  AssignedPrimaries assigned;
};
static_assert(std::is_trivially_copyable_v<UnitPrimaryRays> && sizeof(UnitPrimaryRays) > nodes::small_payload_bytes);

/// The page, or the primary rays, have arrived.
using UnitAcknowledgement = Word;

/// The new owner of a unit for which rays came to a node that is no longer responsible.
struct UnitMoved {
  std::uint32_t unit = 0, version = 0, owner = 0;
};

/// Every node is done.
using Stop = Word;

using nodes::is_small_packet;
static_assert(is_small_packet<Credits> && is_small_packet<Ask> && is_small_packet<FilmAcknowledgement> && is_small_packet<Token>);
static_assert(is_small_packet<PrimariesTaken> && is_small_packet<OverflowTaken>);
static_assert(is_small_packet<UnitAsk> && is_small_packet<UnitRefusal> && is_small_packet<UnitAcknowledgement>);
static_assert(is_small_packet<UnitMoved>);
static_assert(is_small_packet<Finish> && is_small_packet<Done> && is_small_packet<Stop>);

/// Sends a small packet for which the protocol reserves a slot in the target's mailbox (the table above).
template <class T>
void send_control(nodes::Node& node, nodes::NodeId target, Kind kind, const T& value) {
  static_assert(is_small_packet<T>);
  node.grant(target, control_channel);
  node.send_reserved(target, control_channel, number_of(kind), value);
}

/// Sends it to `count` members from `first` on.
template <class T>
void send_control_to(nodes::Node& node, nodes::NodeId first, std::uint32_t count, Kind kind, const T& value) {
  for (std::uint32_t i = 0; i < count; ++i) {
    send_control(node, nodes::NodeId{nodes::index_of(first) + i}, kind, value);
  }
}

/// Passes a token on.
inline void send_tokens(nodes::Node& node, const TokenHandover& handover) {
  send_control_to(node, handover.first, handover.count, Kind::token, handover.token);
}

/// Sends it to the children in the tree.
template <class T>
void notify_children(nodes::Node& node, const TreePlace& place, Kind kind, const T& value) {
  send_control_to(node, nodes::NodeId{place.first_child}, place.child_count, kind, value);
}

}  // namespace dmpc::dataflow

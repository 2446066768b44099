// Messages between nodes about pages: values, without pointers.
//
//   kind                   from -> to          channel   size   its slot in the target's mailbox is reserved by
//   page_request           node -> home        request   small  the sender's request credits for that home, a node or the host
//   passed_request         node -> parent      request   small  the requester's request, which has slots all the way up
//   page_reply             home -> node        bulk      bulk   the request
//
// If nodes ask the host through a tree (svm/pages/request_tree.h) page requests go to the parent, and the reply comes from the
// ancestor that has the page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "nodes/node.h"
#include "nodes/packet.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// All messages of this family, including those about pixels (svm/packets.h) and questions (svm/forest/forest.h), so that a
/// number has one name in every trace.
enum class Kind : nodes::PacketKind {
  page_request,
  page_reply,
  work_request,
  work_reply,
  film_sums,
  film_acknowledgement,
  done,
  stop,
  mask_part,
  mask_acknowledgement,
  begin_pass,
  questions,
  answers,
  passed_request
};
constexpr nodes::PacketKind number_of(Kind kind) { return static_cast<nodes::PacketKind>(kind); }
static_assert(number_of(Kind::passed_request) < nodes::packet_kind_count);
inline constexpr std::array<const char*, 14> kind_names = {
    "page_request", "page_reply",           "work_request", "work_reply", "film_sums", "film_acknowledgement", "done", "stop",
    "mask_part",    "mask_acknowledgement", "begin_pass",   "questions",  "answers",   "passed_request"};
/// The packet's name, for reports.
constexpr const char* name_of(Kind kind) { return kind_names[number_of(kind)]; }

inline constexpr nodes::Channel request_channel = 0;
inline constexpr nodes::Channel bulk_channel = 1;
inline constexpr nodes::Channel ring_channel = 2;
inline constexpr nodes::Channel control_channel = 3;
static_assert(control_channel < nodes::channel_count);

using nodes::is_small_packet;

struct PageRequest {
  PageId page = no_page;
};
static_assert(is_small_packet<PageRequest>);

/// A page request on its way up the tree, passed on by a receiver that does not have the page.
struct PassedRequest {
  PageId page = no_page;
  std::uint32_t requester = 0;
};
static_assert(is_small_packet<PassedRequest>);

/// The page and the requester of a page request, passed on or not.
inline PassedRequest request_in(const nodes::Packet& packet) {
  return Kind{packet.kind} == Kind::passed_request ? packet.as<PassedRequest>()
                                                   : PassedRequest{packet.as<PageRequest>().page, nodes::index_of(packet.source)};
}

/// Precedes the page's bytes.
struct PageReplyHeader {
  PageId page = no_page;
  std::uint32_t padding = 0;
};
static_assert(sizeof(PageReplyHeader) == 8 && std::is_trivially_copyable_v<PageReplyHeader>);
static_assert(sizeof(PageReplyHeader) + page_size_min_bytes > nodes::small_payload_bytes, "every page reply is bulk");

/// The size of a reply with a page of this size.
constexpr std::size_t page_reply_bytes(std::size_t page_size_bytes) { return sizeof(PageReplyHeader) + page_size_bytes; }

}  // namespace dmpc::svm

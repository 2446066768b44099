// A user-defined replacement policy for `dmpc study references` and `dmpc study cache`, or for renders on modelled machines: a
// shared library that they load by its full path (--policy=/home/me/lib.so, --replacement=/home/me/lib.so). A class derived from
// dmpc::Policy and one line, DMPC_POLICY(Class, "name");, define it; other languages export the table that this line defines, as
// the C symbol dmpc_policy. It needs no library of dmpc.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

namespace dmpc {

/// Version of this interface; dmpc accepts libraries that were built for it or for an older one.
inline constexpr std::uint32_t policy_version = 2;

/// What victim() returns in place of a frame for a page that is used once and not cached.
inline constexpr std::uint32_t bypass = 0xffffffffU;

/// Decides which page leaves a full cache when another one arrives. One object is made for each cache, by Class(frame_count,
/// node), those of a render in one process: a node's cache has frame_count > 0 frames, numbered from 0, which are filled in
/// order; no page leaves before all are full. Page numbers are only identifiers. An exception ends the study or render with its
/// message.
class Policy {
 public:
  virtual ~Policy() = default;
  /// The page in a frame is referenced again. Repeated references count as one; the first reference to a new page is its
  /// insert().
  virtual void hit(std::uint32_t /*page*/, std::uint32_t /*frame*/) {}
  /// A page has arrived in a frame that was empty or was returned by victim().
  virtual void insert(std::uint32_t /*page*/, std::uint32_t /*frame*/) {}
  /// Returns the frame whose page is replaced by `incoming`, for which insert() is called next. Every frame has a page. Or
  /// returns `bypass`: no page leaves, insert() is not called, and the next reference to `incoming` is a fault again.
  virtual std::uint32_t victim(std::uint32_t incoming) = 0;
  /// A page is fetched at this price (--price-column; 1 without it): called before its victim() and insert().
  virtual void price(std::uint32_t /*page*/, std::uint32_t /*price*/) {}
};

/// The table that a library exports. Functions return nullptr, or an error message that is valid until the next call.
struct PolicyTable {
  std::uint32_t version;  ///< policy_version; tables of version 1 end with drop
  const char* name;       ///< column name: up to 32 letters, digits, "-", "_" or "."; not the name of one of dmpc's own policies
  const char* (*make)(std::uint32_t frame_count, std::uint32_t node, void** policy);
  const char* (*hit)(void* policy, std::uint32_t page, std::uint32_t frame);
  const char* (*insert)(void* policy, std::uint32_t page, std::uint32_t frame);
  const char* (*victim)(void* policy, std::uint32_t incoming, std::uint32_t* frame);
  void (*drop)(void* policy);
  const char* (*price)(void* policy, std::uint32_t page, std::uint32_t price);  ///< may be null
};

namespace policy_detail {

/// Returns the message of a thrown exception.
template <class Call>
const char* complaint_of(const Call& call) noexcept {
  static thread_local std::string said;
  try {
    call();
    return nullptr;
  } catch (const std::exception& error) {
    said = error.what();
  } catch (...) {
    said = "it threw what is no std::exception";
  }
  return said.c_str();
}

template <class Class>
struct Calls {
  static Policy& of(void* policy) { return *static_cast<Class*>(policy); }
  static const char* make(std::uint32_t frame_count, std::uint32_t node, void** policy) {
    return complaint_of([&] { *policy = new Class(frame_count, node); });
  }
  static const char* hit(void* policy, std::uint32_t page, std::uint32_t frame) {
    return complaint_of([&] { of(policy).hit(page, frame); });
  }
  static const char* insert(void* policy, std::uint32_t page, std::uint32_t frame) {
    return complaint_of([&] { of(policy).insert(page, frame); });
  }
  static const char* victim(void* policy, std::uint32_t incoming, std::uint32_t* frame) {
    return complaint_of([&] { *frame = of(policy).victim(incoming); });
  }
  static void drop(void* policy) { delete static_cast<Class*>(policy); }
  static const char* price(void* policy, std::uint32_t page, std::uint32_t price) {
    return complaint_of([&] { of(policy).price(page, price); });
  }
};

}  // namespace policy_detail

}  // namespace dmpc

/// To be used once in a library, outside of any namespace.
#define DMPC_POLICY(Class, name)                                                         \
  extern "C" __attribute__((visibility("default"))) const dmpc::PolicyTable dmpc_policy; \
  const dmpc::PolicyTable dmpc_policy = {dmpc::policy_version,                           \
                                         name,                                           \
                                         dmpc::policy_detail::Calls<Class>::make,        \
                                         dmpc::policy_detail::Calls<Class>::hit,         \
                                         dmpc::policy_detail::Calls<Class>::insert,      \
                                         dmpc::policy_detail::Calls<Class>::victim,      \
                                         dmpc::policy_detail::Calls<Class>::drop,        \
                                         dmpc::policy_detail::Calls<Class>::price}

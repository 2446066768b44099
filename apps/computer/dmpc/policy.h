// A replacement policy of one's own for `dmpc study references` and `dmpc study cache`: a shared library, which they load by its
// full path (--policy=/home/me/lib.so). A class derived from dmpc::Policy, and one line, DMPC_POLICY(Class, "name");, make it;
// who writes in another language exports the table that this line makes, as the C symbol dmpc_policy. Needs no library of dmpc's.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

namespace dmpc {

/// Version of this interface; dmpc refuses a library that was built for another one.
inline constexpr std::uint32_t policy_version = 1;

/// Decides which page leaves a full cache when another one arrives. Made anew for each cache, by Class(frame_count, node): a
/// node's cache has frame_count > 0 frames, numbered from 0, which are filled in their order; no page leaves before all are.
/// Pages are numbers that say nothing but which page it is. What is thrown ends the study with what it says.
class Policy {
 public:
  virtual ~Policy() = default;
  /// The page in a frame is referenced again. References of one page in a row count as one, the first of a page that came is its
  /// insert().
  virtual void hit(std::uint32_t /*page*/, std::uint32_t /*frame*/) {}
  /// A page has come into a frame that was empty or is victim()'s.
  virtual void insert(std::uint32_t /*page*/, std::uint32_t /*frame*/) {}
  /// The frame whose page leaves now for `incoming`, which insert() names next. Every frame has a page.
  virtual std::uint32_t victim(std::uint32_t incoming) = 0;
};

/// What a library exports. A function returns nullptr, or what went wrong, in words that last until the next call.
struct PolicyTable {
  std::uint32_t version;  ///< policy_version
  const char* name;       ///< column name: up to 32 letters, digits, "-", "_" or "."; no name of dmpc's own policies
  const char* (*make)(std::uint32_t frame_count, std::uint32_t node, void** policy);
  const char* (*hit)(void* policy, std::uint32_t page, std::uint32_t frame);
  const char* (*insert)(void* policy, std::uint32_t page, std::uint32_t frame);
  const char* (*victim)(void* policy, std::uint32_t incoming, std::uint32_t* frame);
  void (*drop)(void* policy);
};

namespace policy_detail {

/// What was thrown, in words.
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
};

}  // namespace policy_detail

}  // namespace dmpc

/// Once in a library, outside of any namespace.
#define DMPC_POLICY(Class, name)                                                         \
  extern "C" __attribute__((visibility("default"))) const dmpc::PolicyTable dmpc_policy; \
  const dmpc::PolicyTable dmpc_policy = {dmpc::policy_version,                           \
                                         name,                                           \
                                         dmpc::policy_detail::Calls<Class>::make,        \
                                         dmpc::policy_detail::Calls<Class>::hit,         \
                                         dmpc::policy_detail::Calls<Class>::insert,      \
                                         dmpc::policy_detail::Calls<Class>::victim,      \
                                         dmpc::policy_detail::Calls<Class>::drop}

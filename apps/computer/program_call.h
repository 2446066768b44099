// Calls of a user's program: any error in one of them is reported with its node.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#include "apps/computer/dmpc/computer.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// Marks the calling thread as executing a call of a node's program during its lifetime. Calls of one node do not overlap.
class CallUnderWay {
 public:
  /// `what` is a string literal such as "work()".
  CallUnderWay(std::uint32_t node, const char* what);
  ~CallUnderWay();
  CallUnderWay(const CallUnderWay&) = delete;
  CallUnderWay& operator=(const CallUnderWay&) = delete;

 private:
  std::uint32_t node_;
};

/// Returns ", in work() of node 1".
std::string place_of_call(std::uint32_t node, const char* what);

/// Returns the result of act(). Foreign exceptions become a ProgramError that names the call, or core::CapacityError if memory is
/// exhausted; dmpc::UsageError and our own errors are passed on.
template <class Act>
std::invoke_result_t<const Act&> call_program(std::uint32_t node, const char* what, const Act& act) {
  const CallUnderWay call(node, what);
  try {
    return act();
  } catch (const std::bad_alloc&) {
    throw core::CapacityError("there is no more memory" + place_of_call(node, what) + ": ask for fewer nodes");
  } catch (const ProgramError& error) {
    throw ProgramError(error.what() + place_of_call(node, what));
  } catch (const dmpc::UsageError&) {
    throw;
  } catch (const core::InternalError&) {
    throw;
  } catch (const core::InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw ProgramError(error.what() + place_of_call(node, what));
  } catch (...) {
    throw ProgramError("what it threw is no std::exception" + place_of_call(node, what));
  }
}

/// During its lifetime, an end without an exception is reported with its node, too: a crash, which remains a crash, and a call of
/// std::exit(), whose status becomes internal_status. Only one object may exist at a time. `name` is the prefix of messages.
class ProgramEnds {
 public:
  explicit ProgramEnds(const std::string& name);
  ~ProgramEnds();
  ProgramEnds(const ProgramEnds&) = delete;
  ProgramEnds& operator=(const ProgramEnds&) = delete;

  /// Returns a function for a thread that polls once a second; it reports each call that has not returned for a long time, once.
  std::function<void()> look() const;

 private:
  struct Actions;
  std::unique_ptr<Actions> before_;  ///< the previous signal actions
};

}  // namespace dmpc::apps

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

/// While it lives, the calling thread is in a call of a node's program. Calls of one node do not overlap.
class CallUnderWay {
 public:
  /// `what` is a literal: "work()".
  CallUnderWay(std::uint32_t node, const char* what);
  ~CallUnderWay();
  CallUnderWay(const CallUnderWay&) = delete;
  CallUnderWay& operator=(const CallUnderWay&) = delete;

 private:
  std::uint32_t node_;
};

/// ", in work() of node 1".
std::string place_of_call(std::uint32_t node, const char* what);

/// What act() returns. What is not ours that it throws comes as a ProgramError that says where, or as core::CapacityError where
/// memory ends; dmpc::UsageError and our own errors as they are.
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

/// During its lifetime, an end without an exception is reported with its node, too: a crash, which still is one, and a call of
/// std::exit(), which becomes an end with internal_status. One at a time. `name`: what stands before what is said.
class ProgramEnds {
 public:
  explicit ProgramEnds(const std::string& name);
  ~ProgramEnds();
  ProgramEnds(const ProgramEnds&) = delete;
  ProgramEnds& operator=(const ProgramEnds&) = delete;

  /// For a thread that looks once a second: says of a call that has not returned for long, once.
  std::function<void()> look() const;

 private:
  struct Actions;
  std::unique_ptr<Actions> before_;  ///< what signals did
};

}  // namespace dmpc::apps

#include "nodes/ranks/failure.h"

#include <new>

#include "core/base/expect.h"
#include "nodes/ranks/fabric.h"
#include "nodes/ranks/frame.h"

namespace dmpc::nodes {

Failure failure_of(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const core::CapacityError& error) {
    return {FailureKind::room, error.what()};
  } catch (const std::bad_alloc&) {
    return {FailureKind::room, "there is no more memory: ask for fewer nodes"};
  } catch (const FabricError& error) {
    return {FailureKind::fabric, error.what()};
  } catch (const std::exception& error) {
    return {FailureKind::internal, error.what()};
  } catch (...) {
    return {FailureKind::internal, "something that is no error"};
  }
}

void fail_as(FailureKind kind, const std::string& text) {
  switch (kind) {
    case FailureKind::room:
      throw core::CapacityError(text);
    case FailureKind::fabric:
      throw FabricError(text);
    case FailureKind::internal:
      break;
  }
  throw core::InternalError(text);
}

void say_failure(RankLinks& links, const Failure& failure) {
  std::string word(1, static_cast<char>(failure.kind));
  word += failure.text.substr(0, links.frame_bytes() / 2 - 1);  // one item, not several
  links.say(0, Item::failure, std::as_bytes(std::span(word)));
}

void fail_as_said(const std::string& rank_name, std::span<const std::byte> word) {
  core::expect(!word.empty(), "a failure has a kind");
  const std::string text(reinterpret_cast<const char*>(word.data()) + 1, word.size() - 1);
  fail_as(static_cast<FailureKind>(word.front()), rank_name + ": " + text);
}

}  // namespace dmpc::nodes

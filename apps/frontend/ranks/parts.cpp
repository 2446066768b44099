#include "apps/frontend/ranks/parts.h"

#include <exception>
#include <new>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/system/interrupt.h"
#include "core/base/expect.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/failure.h"

namespace dmpc::apps {
namespace {

/// With which main() will end.
int exit_status_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Interrupted&) {
    return interrupted_status;
  } catch (const core::CapacityError&) {
    return no_capacity_status;
  } catch (const core::InputError&) {
    return input_status;
  } catch (const core::UsageError&) {
    return usage_status;
  } catch (const std::bad_alloc&) {
    return no_capacity_status;
  } catch (...) {
    return internal_status;
  }
}

}  // namespace

int lead(nodes::RankLinks& links, const std::function<int()>& work) {
  try {
    const int status = work();
    nodes::dismiss(links, status);
    return status;
  } catch (const nodes::LostRank&) {
    throw;  // the others find it out, too
  } catch (...) {
    nodes::dismiss(links, exit_status_of(std::current_exception()));
    throw;
  }
}

/// Rank 0 knows of errors in a run; earlier errors are reported to it.
int follow(nodes::RankLinks& links, const std::function<void()>& work) {
  try {
    work();
  } catch (const nodes::Dismissed& dismissed) {
    return dismissed.status;
  } catch (const nodes::LostRank&) {
    nodes::let_rank_0_speak();
    throw;
  } catch (const Interrupted&) {  // as all are
  } catch (...) {
    nodes::say_failure(links, nodes::failure_of(std::current_exception()));
  }
  return nodes::wait_for_dismissal(links);
}

}  // namespace dmpc::apps

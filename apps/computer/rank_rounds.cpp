#include "apps/computer/rank_rounds.h"

#include <cstdint>

#include "apps/computer/dmpc/computer.h"
#include "nodes/byte_source.h"

namespace dmpc::apps {

RankRounds::RankRounds(nodes::RankLinks& links) : links_(links) {
  if (is_first()) {
    to_others_.emplace(links);
  } else {
    from_first_.emplace(links);
  }
}

void RankRounds::here(const std::function<void()>& forwarded_call) {
  call_forwarder_.send([&] {
    expect_no_failure();
    try {
      forwarded_call();
    } catch (...) {
      failed_call_ = std::current_exception();
      throw;
    }
  });
}

void RankRounds::expect_no_failure() const {
  if (failed_call_) {
    std::rethrow_exception(failed_call_);
  }
}

void RankRounds::agree(const std::string& next) {
  expect_no_failure();
  if (is_first()) {
    for (std::uint32_t rank = 1; rank < links_.rank_count(); ++rank) {
      to_others_->write_counted(rank, std::as_bytes(std::span(next)));
    }
  } else if (const std::string expected = nodes::read_counted(*from_first_); next != expected) {
    throw ProgramError("the ranks have parted: here comes " + next + ", on " + links_.name_of(0) + " " + expected +
                       ": a program must do the same on all of them");
  }
}

void RankRounds::meet() {
  if (is_first()) {
    to_others_->finish();
  } else {
    from_first_->say_ready();
  }
}

void RankRounds::share(std::span<std::byte> bytes) {
  if (!is_first()) {
    return from_first_->read(bytes);
  }
  for (std::uint32_t rank = 1; rank < links_.rank_count(); ++rank) {
    to_others_->write(rank, bytes);
  }
}

void RankRounds::look_after() {
  if (is_first()) {
    to_others_->look_after();
  } else {
    from_first_->look_after();
  }
}

}  // namespace dmpc::apps

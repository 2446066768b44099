#include "nodes/ranks/gathering_talk.h"

#include <utility>

namespace dmpc::nodes {
namespace {

void append(std::string& text, std::span<const std::byte> bytes) {
  text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

bool GatheringTalk::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
  switch (header.item) {
    case Item::report:
      append(reports_.at(header.target), bytes);
      return true;
    case Item::reported:
      ++ranks_reported_;
      return true;
    case Item::rank_traffic:
      rank_reports_[rank].traffic = value_of<RankTraffic>(bytes);
      return true;
    case Item::rank_report:
      append(rank_reports_[rank].told, bytes);
      return true;
    case Item::rank_reported:
      ++ranks_told_;
      return true;
    default:
      return false;
  }
}

std::vector<std::string> GatheringTalk::gather(std::vector<std::string> told, const Wait& wait) {
  if (links_->rank() == 0) {
    wait([this] { return ranks_reported_ + 1 == links_->rank_count(); });
    for (std::size_t index = 0; index < told.size(); ++index) {
      told[index] += reports_[index];
    }
    return told;
  }
  for (std::uint32_t index = 0; index < told.size(); ++index) {
    if (!told[index].empty()) {
      links_->say(0, Item::report, std::as_bytes(std::span(told[index])), index);
    }
  }
  links_->say(0, Item::reported, {});
  wait([this] { return links_->has_said_all(); });
  return told;
}

std::vector<RankReport> GatheringTalk::gather_ranks(RankReport own, const Wait& wait) {
  if (links_->rank() == 0) {
    wait([this] { return ranks_told_ + 1 == links_->rank_count(); });
    rank_reports_.front() = std::move(own);
    return std::move(rank_reports_);
  }
  links_->say(0, Item::rank_traffic, bytes_of(own.traffic));
  links_->say(0, Item::rank_report, std::as_bytes(std::span(own.told)));
  links_->say(0, Item::rank_reported, {});
  wait([this] { return links_->has_said_all(); });
  return {};
}

}  // namespace dmpc::nodes

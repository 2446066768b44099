#include "nodes/ranks/closing_talk.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "nodes/standstill.h"

namespace dmpc::nodes {
namespace {

/// How the last word of a rank travels, behind its text.
struct Closing {
  Ending ending;
  FailureKind kind;
};

}  // namespace

bool ClosingTalk::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
  LastWord& word = last_words_[rank];
  if (header.item == Item::text) {
    word.text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return true;
  }
  if (header.item == Item::closing) {
    word.ending = value_of<Closing>(bytes).ending;
    word.kind = value_of<Closing>(bytes).kind;
    nodes_->end(word.ending);
    return true;
  }
  return false;
}

void ClosingTalk::close() {
  is_closing_ = true;
  nodes_->join();
  const LastWord word = own_word();
  if (!word.text.empty()) {
    links_->say_to_all(Item::text, std::as_bytes(std::span(word.text)));
  }
  links_->say_to_all(Item::closing, bytes_of(Closing{word.ending, word.kind}));
}

ClosingTalk::LastWord ClosingTalk::own_word() const {
  LastWord word{.ending = nodes_->ending()};
  if (word.ending == Ending::stalled) {
    word.text = nodes_->describe();
  }
  if (nodes_->failure()) {
    Failure failure = failure_of(nodes_->failure());
    word.kind = failure.kind;
    word.text = std::move(failure.text);
  }
  return word;
}

bool ClosingTalk::is_closed() const {
  const auto is_silent = [](const LastWord& word) { return word.ending == Ending::none; };
  return is_closing_ && std::count_if(last_words_.begin(), last_words_.end(), is_silent) == 1 && links_->has_said_all();
}

RunEnd ClosingTalk::judge(const std::optional<Chaos>& disturbance) const {
  const auto gravity = [](const LastWord& word) { return std::pair(word.ending, !word.text.empty()); };
  const auto gravest = std::max_element(last_words_.begin(), last_words_.end(),
                                        [&](const LastWord& a, const LastWord& b) { return gravity(a) < gravity(b); });
  switch (std::max(nodes_->ending(), gravest->ending)) {
    case Ending::failed:
      if (nodes_->failure()) {
        std::rethrow_exception(nodes_->failure());
      }
      fail_as(gravest->kind, links_->name_of(static_cast<std::uint32_t>(gravest - last_words_.begin())) + ": " + gravest->text);
    case Ending::stalled:
      throw StandstillError(stall_text(disturbance) + nodes_->describe() + texts());
    case Ending::interrupted:
      return RunEnd::interrupted;
    default:
      return RunEnd::finished;
  }
}

/// The texts of the other ranks.
std::string ClosingTalk::texts() const {
  std::string texts;
  for (const LastWord& word : last_words_) {
    texts += word.text;
  }
  return texts;
}

}  // namespace dmpc::nodes

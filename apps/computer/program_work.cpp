#include "apps/computer/program_work.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "apps/computer/declared.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

constexpr auto install_bit = 1U << static_cast<std::uint32_t>(core::Charge::page_install);

}  // namespace

ProgramWork program_work(const Vocabulary& vocabulary) {
  const std::vector<NamedOperation>& operations = vocabulary.operations;
  const bool has_pages = vocabulary.has_pages();
  const std::size_t shown = std::min<std::size_t>(operations.size(), has_pages ? 3 : 4);
  ProgramWork work;
  std::vector<std::uint32_t> bits;
  for (std::size_t i = 0; i < shown; ++i) {
    bits.push_back(1U << operations[i].charge);
    work.names.push_back(own_name(operations[i].name));
  }
  work.names.emplace_back(shown > 0 ? "other computing" : "computing");
  if (has_pages) {
    work.names.emplace_back("pages");
  }
  work.names.emplace_back("messages");
  const std::size_t messages = work.names.size() - 1, pages = has_pages ? shown + 1 : shown;
  work.work_of = [bits = std::move(bits), pages, messages](const nodes::Span& span) {
    if (span.activity == nodes::Activity::send || span.activity == nodes::Activity::take_over) {
      return messages;
    }
    const std::uint32_t charged = span.charged();
    const auto first = std::find_if(bits.begin(), bits.end(), [charged](std::uint32_t bit) { return (charged & bit) != 0; });
    const bool is_paging = span.activity == nodes::Activity::serve || charged == install_bit;
    return first == bits.end() && is_paging ? pages : static_cast<std::size_t>(first - bits.begin());
  };
  return work;
}

}  // namespace dmpc::apps

#include "apps/frontend/show/references/reference_file.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/byte_order_mark.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t trace_line_characters_max = 4096;
/// One less than there are page numbers, so that each reference may be of a page of its own.
constexpr std::uint64_t trace_references_max = std::numeric_limits<std::uint32_t>::max() - 1;

constexpr std::uint64_t price_max = std::numeric_limits<std::uint32_t>::max();

using PageName = std::uint64_t;

constexpr int first_of_gzip = 0x1f;

/// Positions of the columns, from the header line.
struct Columns {
  std::size_t page = 0;
  std::optional<std::size_t> node, price;
  std::size_t count = 0;
};

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0;; ++begin) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    if (end == line.size()) {
      return fields;
    }
    begin = end;
  }
}

/// A file's own errors have its name, those of what is packed in it have none.
core::InputError named(const std::string& name, const core::InputError& error) {
  const std::string text = error.what();
  return core::InputError(text.starts_with(name + ": ") ? text : name + ": " + text);
}

class ReferenceReader {
 public:
  ReferenceReader(std::istream& input, std::string name, const ReferenceColumns& wanted)
      : input_(input), name_(std::move(name)), wanted_(wanted) {}

  ReferenceTrace read() {
    const Columns columns = read_columns();
    while (next_line()) {
      read_reference(columns);
    }
    if (trace_.reference_count == 0) {
      fail("there is no reference; expected a line for each, such as 0,1,17,1024");
    }
    number_pages();
    return std::move(trace_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError(name_ + ":" + std::to_string(line_number_) + ": " + what);
  }

  /// Empty lines are passed over, and the carriage returns of other systems.
  bool next_line() {
    do {
      line_.clear();
      ++line_number_;
      for (int character = next_character(); character != '\n'; character = next_character()) {
        if (character == std::istream::traits_type::eof()) {
          return !line_.empty();
        }
        if (line_.size() == trace_line_characters_max) {
          fail("the line has more than " + std::to_string(trace_line_characters_max) + " characters; expected a CSV file");
        }
        line_.push_back(static_cast<char>(character));
      }
      if (line_.ends_with('\r')) {
        line_.pop_back();
      }
    } while (line_.empty());
    return true;
  }

  int next_character() {
    return guarded([this] { return input_.get(); });
  }
  int first_character() {
    return guarded([this] { return input_.peek(); });
  }

  template <class Look>
  int guarded(const Look& look) {
    try {
      return look();
    } catch (const core::InputError& error) {  // a pipe that delivers nothing, or too much
      throw named(name_, error);
    }
  }

  Columns read_columns() {
    if (first_character() == first_of_gzip) {
      throw core::InputError(name_ + ": it is packed; expected a CSV file: zcat FILE | dmpc study references -");
    }
    if (!next_line()) {
      fail("the file is empty; expected a line such as node,number,page,bytes, and one for each reference");
    }
    const std::vector<std::string_view> names = fields_of(without_mark(line_));
    const auto place = [&names](std::string_view name) -> std::optional<std::size_t> {
      const auto found = std::find(names.begin(), names.end(), name);
      return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
    };
    const auto required = [&](const std::string& name) {
      const std::optional<std::size_t> found = place(name);
      if (!found) {
        fail("no column is called " + name + "; expected the names of the columns, such as node,number,page,bytes");
      }
      return *found;
    };
    const auto optional = [&](const std::optional<std::string>& name) {
      return name ? std::optional(required(*name)) : std::nullopt;
    };
    return {required(wanted_.page), wanted_.node ? optional(wanted_.node) : place("node"), optional(wanted_.price), names.size()};
  }

  std::uint64_t number_in(std::string_view field, const char* column, std::uint64_t most) const {
    const auto number = apps::number_in<std::uint64_t>(field);
    if (!number || *number > most) {
      fail(std::string("the ") + column + " is '" + std::string(field.substr(0, 40)) + "'; expected a whole number up to " +
           std::to_string(most));
    }
    return *number;
  }

  void read_reference(const Columns& columns) {
    const std::vector<std::string_view> fields = fields_of(line_);
    if (fields.size() != columns.count) {
      fail("this line has " + std::to_string(fields.size()) + " columns, the first one has " + std::to_string(columns.count));
    }
    if (++trace_.reference_count > trace_references_max) {
      throw core::CapacityError(name_ + ": there are more than " + std::to_string(trace_references_max) +
                                " references; give those of fewer nodes, or of a part of the run");
    }
    const std::uint64_t node = columns.node ? number_in(fields[*columns.node], "node", nodes::node_count_max - 1) : 0;
    const PageName page = number_in(fields[columns.page], "page", std::numeric_limits<PageName>::max());
    const std::uint64_t price = columns.price ? number_in(fields[*columns.price], "price", price_max) : 0;
    if (node >= names_.size()) {
      names_.resize(node + 1);
      trace_.prices.resize(columns.price ? node + 1 : 0);
    }
    if (names_[node].empty() || names_[node].back() != page) {
      names_[node].push_back(page);
      if (columns.price) {
        trace_.prices[node].push_back(static_cast<std::uint32_t>(price));
      }
    }
  }

  /// In the order of their names. No table by hash: a file could choose names that fall on each other.
  void number_pages() {
    std::vector<PageName> all;
    for (const std::vector<PageName>& names : names_) {
      all.insert(all.end(), names.begin(), names.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    trace_.page_count = static_cast<std::uint32_t>(all.size());
    for (const std::vector<PageName>& names : names_) {
      std::vector<svm::PageId>& pages = trace_.nodes.emplace_back();
      pages.reserve(names.size());
      for (const PageName name : names) {
        pages.push_back(svm::PageId{static_cast<std::uint32_t>(std::lower_bound(all.begin(), all.end(), name) - all.begin())});
      }
    }
  }

  std::istream& input_;
  std::string name_;
  ReferenceColumns wanted_;
  std::string line_;
  std::uint64_t line_number_ = 0;
  std::vector<std::vector<PageName>> names_;  ///< by node
  ReferenceTrace trace_;
};

/// So much of a packed text is looked at behind a fault; no more, since a pipe may never end.
constexpr std::streamsize text_behind_fault_max = std::streamsize{1} << 30U;

/// A text that is damaged while it is packed becomes another one, with a fault of its own, before the sum at its end says so.
/// Throws core::InputError if it is.
void check_rest(std::istream& text, const std::string& name) {
  try {
    if (text.good()) {
      text.ignore(text_behind_fault_max);
    }
  } catch (const core::InputError& error) {
    throw named(name, error);
  }
}

ReferenceTrace read_packed(std::istream& text, const std::string& name, const ReferenceColumns& columns) {
  try {
    return read_references(text, name, columns);
  } catch (const core::CapacityError&) {
    throw;
  } catch (const core::InputError&) {
    check_rest(text, name);
    throw;
  }
}

bool is_packed(std::istream& input, const std::string& name) {
  try {
    return input.peek() == first_of_gzip;
  } catch (const core::InputError& error) {  // a pipe that delivers nothing
    throw named(name, error);
  }
}

}  // namespace

void write_references(std::ostream& output, const std::vector<svm::ReferenceLog>& logs, std::size_t page_bytes) {
  output << "node,number,page,bytes\n";
  for (std::size_t node = 0; node < logs.size(); ++node) {
    const std::span<const svm::PageId> pages = logs[node].pages();
    for (std::size_t i = 0; i < pages.size(); ++i) {
      output << node << ',' << i << ',' << svm::index_of(pages[i]) << ',' << page_bytes << '\n';
    }
  }
}

ReferenceTrace read_references(std::istream& input, const std::string& name, const ReferenceColumns& columns) {
  return ReferenceReader(input, name, columns).read();
}

ReferenceTrace read_references(const std::filesystem::path& path, const ReferenceColumns& columns, const UnpackText& unpack) {
  const bool is_standard = path == "-";
  const std::string name = is_standard ? "the standard input" : path.string();
  std::unique_ptr<TextInput> input;
  try {
    input = std::make_unique<TextInput>(is_standard ? "/dev/stdin" : path);
  } catch (const core::InputError& error) {
    throw core::InputError(std::string(error.what()) + "; a CSV file of page references was expected");
  }
  if (unpack && is_packed(*input, name)) {
    return read_packed(*unpack(*input), name, columns);
  }
  return read_references(*input, name, columns);
}

}  // namespace dmpc::apps

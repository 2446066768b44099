// Page references as a CSV file: what render --references writes, and what other programs have recorded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "svm/pages/observers/reference_log.h"
#include "svm/pages/page.h"

namespace dmpc::apps {

/// Who referenced what, in order.
struct ReferenceTrace {
  std::vector<std::vector<svm::PageId>> nodes;  ///< by node; of one page in a row the first
  std::uint64_t reference_count = 0;            ///< including those left out
  std::uint32_t page_count = 0;                 ///< different pages, numbered from 0 on
};

/// One line for what the columns are, one for each reference: the node, the number of the reference of this node's, the page, and
/// how many bytes it has.
void write_references(std::ostream& output, const std::vector<svm::ReferenceLog>& logs, std::size_t page_bytes);

/// What columns are called.
struct ReferenceColumns {
  std::string page = "page";
  std::optional<std::string> node;  ///< must be there; nothing: "node", or all are node 0's
};

/// Reads a file or a pipe, or, as "-", the standard input, if that is one of them, with a column of pages, and perhaps one of
/// nodes; others are passed over. Pages are whole numbers below 2^64, whatever they mean. Throws core::InputError naming the
/// line, core::CapacityError for more than 2^32 - 2 references.
/// What is packed by gzip goes through `unpack`, if there is one, and is refused else.
using UnpackText = std::function<std::unique_ptr<std::istream>(std::istream&)>;
ReferenceTrace read_references(const std::filesystem::path& path, const ReferenceColumns& columns = {},
                               const UnpackText& unpack = {});
/// Reads text that is called `name` in messages.
ReferenceTrace read_references(std::istream& input, const std::string& name, const ReferenceColumns& columns = {});

}  // namespace dmpc::apps

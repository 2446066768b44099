// Page references as a CSV file, from render --references or from other programs.
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

/// References by node, in order.
struct ReferenceTrace {
  std::vector<std::vector<svm::PageId>> nodes;     ///< by node; consecutive references to one page count once
  std::vector<std::vector<std::uint32_t>> prices;  ///< of a miss of each of these, by node, if there is such a column
  std::uint64_t reference_count = 0;               ///< including those left out
  std::uint32_t page_count = 0;                    ///< different pages, numbered from 0 on
};

/// A header line, and a line for each reference: the node, the reference's number on this node, the page, and its number of
/// bytes.
void write_references(std::ostream& output, const std::vector<svm::ReferenceLog>& logs, std::size_t page_bytes);

/// Names of columns.
struct ReferenceColumns {
  std::string page = "page";
  std::optional<std::string> node;   ///< must exist; nothing: "node", or all references are node 0's
  std::optional<std::string> price;  ///< of the price of a miss; must exist
};

/// Reads a file or a pipe, or, as "-", the standard input if it is one of these, with a column of pages and optional ones of
/// nodes and prices; other columns are ignored. Pages are any integers below 2^64, prices below 2^32. Throws core::InputError
/// naming the line, core::CapacityError for more than 2^32 - 2 references. Gzip files are read through `unpack`; without it they
/// are refused.
using UnpackText = std::function<std::unique_ptr<std::istream>(std::istream&)>;
ReferenceTrace read_references(const std::filesystem::path& path, const ReferenceColumns& columns = {},
                               const UnpackText& unpack = {});
/// Reads text; messages call it `name`.
ReferenceTrace read_references(std::istream& input, const std::string& name, const ReferenceColumns& columns = {});

}  // namespace dmpc::apps

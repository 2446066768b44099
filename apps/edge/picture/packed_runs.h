// Bytes in fewer, without a library: pictures of few colours are mostly runs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A stream of P. Deutsch, "DEFLATE Compressed Data Format Specification", RFC 1951, 1996, with its fixed codes: what repeats the
/// byte before, or what stands `row_bytes` before, 1 to 32,768, is said as a length. Never longer than 9/8 of the bytes and 2.
std::string packed_runs(std::string_view bytes, std::size_t row_bytes);

}  // namespace dmpc::apps

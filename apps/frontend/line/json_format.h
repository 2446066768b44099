// The format version in our JSON files.
#pragma once

namespace dmpc::apps {

/// "format", the first key of each: counted up when a key goes or comes to mean something else; not for a new one.
inline constexpr int json_format = 2;

}  // namespace dmpc::apps

// What programs call things that the computer knows by number.
#pragma once

#include <type_traits>

namespace dmpc::nodes {

/// An enum of whoever wrote a program.
template <class Name>
concept ProgramsName = std::is_enum_v<Name>;

}  // namespace dmpc::nodes

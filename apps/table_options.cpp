#include "apps/table_options.h"

namespace dmpc::apps {

void add_format_option(OptionSet options, TableFormat& format) {
  options.add_choice<TableFormat>("--format", format,
                                  {{"markdown", TableFormat::markdown}, {"csv", TableFormat::csv}, {"json", TableFormat::json}},
                                  "How the table is written");
}

}  // namespace dmpc::apps

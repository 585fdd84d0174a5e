#pragma once

namespace weft {

struct RunReport;

/// Notes, before what is noted already, in which frames many points were put back to where their
/// step began, and in which cloth lagged behind since steps were gone in part only.
void note_what_stood_still(RunReport& report);

}  // namespace weft

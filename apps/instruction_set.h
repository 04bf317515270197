// Programs for several instruction sets beside each other, of which a call runs one. They are whole programs
// (INTERSTICE_ISAS): nothing compiled for one set is linked with what another runs.
#pragma once

#include <string>

namespace interstice::apps {

/// The call that main() got: it is passed on when another program takes over.
void note_call(char** arguments);

/// Replaces this program by that for the set that is asked for, `interstice-SET` beside it or in
/// ../libexec/interstice; "auto": by the richest that is there and that this machine has, if it is richer
/// than this one's. Returns where this program is the right one. Throws InputError for a set that is not
/// there or that the machine lacks.
void run_on_instruction_set(const std::string& asked);

}  // namespace interstice::apps

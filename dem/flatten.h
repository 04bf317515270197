// Whether the loops over grains and contacts are compiled as one piece.
#pragma once

/// All that a loop calls becomes part of it. Not under sanitizers: with their checks around every access such
/// a piece takes a quarter of an hour to compile.
#ifdef INTERSTICE_SANITIZED
#define INTERSTICE_FLATTEN
#else
#define INTERSTICE_FLATTEN [[gnu::flatten]]
#endif

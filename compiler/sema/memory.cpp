// A shader has no memory between points: while shading, nothing may be assigned that the top level made. Each function
// that runs while shading is walked as such, so the write is refused where it is met, with the calls that lead there.
#include "compiler/sema/context.h"

namespace moonshade::sema {

using Code = DiagnosticCode;

void refuse_memory(Context& context, const Work& work, std::string_view name, Span declared, Span place) {
  // Of a function that nothing calls, it is not known when it would run.
  if (context.specialise_unknown) return;
  Diagnostic& diagnostic = context.error(Code::NoMemory, place, {std::string(name)});
  if (&diagnostic == &context.silent) return;
  diagnostic.note(Code::NoteDeclaredHere, declared, {std::string(name)});
  constexpr int kMostNotes = 8;
  const Work* at = &work;
  for (int notes = 0; notes < kMostNotes && at->caller != nullptr; ++notes, at = at->caller)
    diagnostic.note(Code::NoteInSpecialisation, at->call_span, {signature(*at)});
}

} // namespace moonshade::sema

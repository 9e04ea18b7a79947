#include "compiler/syntax/token.h"

#include <algorithm>
#include <array>

namespace moonshade::syntax {
namespace {

constexpr auto kSpellings = std::to_array<std::string_view>({
#define MOONSHADE_TOKEN(name, spelling) spelling,
#include "compiler/syntax/tokens.def"
});

struct Keyword {
  std::string_view spelling;
  TokenKind kind;
};

constexpr auto kKeywords = std::to_array<Keyword>({
#define MOONSHADE_KEYWORD(name, spelling) {spelling, TokenKind::name},
#include "compiler/syntax/tokens.def"
});
static_assert(std::ranges::is_sorted(kKeywords, {}, &Keyword::spelling));

} // namespace

std::string_view spelling_of(TokenKind kind) { return kSpellings.at(static_cast<size_t>(kind)); }

TokenKind keyword_or_name(std::string_view text) {
  const auto found = std::ranges::lower_bound(kKeywords, text, {}, &Keyword::spelling);
  return found != kKeywords.end() && found->spelling == text ? found->kind : TokenKind::Name;
}

} // namespace moonshade::syntax

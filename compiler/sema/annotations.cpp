// Reads annotations and compares them (annotations.h). A function's are compared with every specialisation of it that
// some entry point reaches.
#include "compiler/sema/annotations.h"

#include "compiler/sema/names.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

// ---- reading -------------------------------------------------------------------------------------------------------

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_name(char c) { return ('a' <= (c | 32) && (c | 32) <= 'z') || ('0' <= c && c <= '9') || c == '_'; }

/// A comment's text with a position in it.
class Scanner {
public:
  explicit Scanner(const Comment& comment) : text_(comment.text), span_(comment.span) {}

  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_]))
      ++at_;
  }

  AnnotatedType name() {
    const size_t begin = at_;
    while (at_ < text_.size() && (is_name(text_[at_]) || text_[at_] == '.'))
      ++at_;
    return slice(begin);
  }

  /// Up to the blank or comma that ends it outside brackets; blanks around `|` belong to it.
  AnnotatedType type() {
    const size_t begin = at_;
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '(' || c == '[' || c == '{' || c == '<') ++depth;
      if ((c == ')' || c == ']' || c == '}' || c == '>') && depth > 0) --depth;
      if (depth > 0) continue;
      if (c == ',' || c == '#' || c == '@') break;
      if (is_blank(c) && !is_around_bar()) break;
    }
    AnnotatedType type = slice(begin);
    while (!type.text.empty() && is_blank(type.text.back())) {
      type.text.remove_suffix(1);
      --type.span.end;
    }
    return type;
  }

private:
  /// The blank at the position stands before or behind a `|`, or behind the colon of a function's result.
  bool is_around_bar() const {
    const size_t next = text_.find_first_not_of(" \t", at_), last = text_.find_last_not_of(" \t", at_);
    return (next != std::string_view::npos && text_[next] == '|') ||
           (last != std::string_view::npos && (text_[last] == '|' || text_[last] == ':'));
  }

  AnnotatedType slice(size_t begin) const {
    const auto from = static_cast<uint32_t>(span_.begin + begin), to = static_cast<uint32_t>(span_.begin + at_);
    return {text_.substr(begin, at_ - begin), {span_.file, from, to}};
  }

  std::string_view text_;
  Span span_;
  size_t at_ = 0;
};

// ---- comparing -----------------------------------------------------------------------------------------------------

enum class Verdict : uint8_t { Fits, Differs, Open };

/// One name of a type against an inferred type; Open where the dialect knows no such type.
Verdict compare_name(std::string_view name, const Type& type) {
  if (is_unknown(type) || type == conflicting_type()) return Verdict::Open;
  const auto verdict = [](bool fits) { return fits ? Verdict::Fits : Verdict::Differs; };
  for (int value = 0; value <= static_cast<int>(ValueType::Mat4); ++value)
    if (name == name_of(static_cast<ValueType>(value)))
      return verdict(type.is(static_cast<ValueType>(value)) || (name == "number" && is_scalar(type)));
  if (name == "string") return verdict(type.kind == Type::Kind::String);
  if (name == "function") return verdict(is_function(type));
  if (name == "nil") return verdict(type.kind == Type::Kind::None);
  if (name == "table")
    return type.is_value() || type.kind == Type::Kind::String || is_function(type) ? Verdict::Differs : Verdict::Open;
  return Verdict::Open;
}

Verdict compare(std::string_view text, const Type& type) {
  if (text.find_first_of("([{<\"'`") != std::string_view::npos) return Verdict::Open;
  while (true) {
    const size_t bar = text.find('|');
    std::string_view name = text.substr(0, bar);
    while (!name.empty() && is_blank(name.front()))
      name.remove_prefix(1);
    while (!name.empty() && (is_blank(name.back()) || name.back() == '?')) // nil is no value of the dialect
      name.remove_suffix(1);
    const Verdict verdict = compare_name(name, type);
    if (verdict != Verdict::Differs || bar == std::string_view::npos) return verdict;
    text.remove_prefix(bar + 1);
  }
}

constexpr std::string_view kTypeNames[] = {"boolean", "integer", "number", "vec2",     "vec3", "vec4",
                                           "mat3",    "mat4",    "string", "function", "table"};

class Checker {
public:
  explicit Checker(Context& context) : context_(context) {
    for (const Work* work : context.in_order)
      if (work->spec != nullptr) works_[work->function].push_back(work);
  }

  void check() {
    for (const Chunk* chunk : context_.chunks())
      for (const Function* function : chunk->functions) {
        function_ = function;
        block(*function->body);
      }
  }

private:
  void block(const Block& block) {
    for (const Stat* stat : block.stats)
      statement(*stat);
  }

  void statement(const Stat& stat) {
    visit(
        stat,
        Overloaded{
            [&](const LocalStat& local) {
              if (!local.values.empty()) annotated_function(local.comments, local.values[0]);
              annotated_locals(local);
            },
            [&](const AssignStat& assign) {
              if (!assign.values.empty()) annotated_function(assign.comments, assign.values[0]);
            },
            [&](const FunctionStat& definition) { annotated_function(definition.comments, definition.function); },
            [&](const LocalFunctionStat& definition) { annotated_function(definition.comments, definition.function); },
            [&](const DoStat& body) { block(*body.body); },
            [&](const WhileStat& loop) { block(*loop.body); },
            [&](const RepeatStat& loop) { block(*loop.body); },
            [&](const NumericForStat& loop) { block(*loop.body); },
            [&](const GenericForStat& loop) { block(*loop.body); },
            [&](const IfStat& branch) {
              for (const IfClause& clause : branch.clauses)
                block(*clause.body);
              if (branch.else_body != nullptr) block(*branch.else_body);
            },
            [](const auto&) {},
        });
  }

  // ---- functions ----

  void annotated_function(CommentLines comments, const Expr* value) {
    const auto* function = try_as<Function>(value);
    if (function == nullptr) return;
    size_t result = 0;
    for (const Comment& comment : comments) {
      const auto annotation = read_annotation(comment);
      if (!annotation) continue;
      if (annotation->kind == Annotation::Kind::Param) parameter(*function, *annotation);
      if (annotation->kind != Annotation::Kind::Return) continue;
      for (const AnnotatedType& type : annotation->types)
        this->result(*function, type, result++);
    }
  }

  void parameter(const Function& function, const Annotation& annotation) {
    const auto found = std::ranges::find(function.params, annotation.name, &Local::name);
    if (found == function.params.end()) {
      std::vector<std::string_view> names;
      for (const Local* param : function.params)
        names.push_back(param->name);
      const auto near = nearest(annotation.name, names);
      suggest_fix(context_.diagnostics.report(Code::AnnotatedParameter, annotation.name_span,
                                              {std::string(annotation.name), suggestion(near)}),
                  near);
      return;
    }
    check_name(annotation.types[0]);
    const auto index = static_cast<size_t>(found - function.params.begin());
    for_each_work(function, [&](const Work& work) {
      if (index >= work.arguments.size()) return false;
      return differs(annotation.types[0], "'" + std::string(annotation.name) + "'", work.arguments[index], work,
                     (*found)->span);
    });
  }

  void result(const Function& function, const AnnotatedType& annotated, size_t index) {
    check_name(annotated);
    for_each_work(function, [&](const Work& work) {
      if (!work.has_results) return false;
      const bool is_there = index < work.results.size();
      const Span place = is_there ? work.result_spans[index] : work.first_return;
      return differs(annotated, "the result", is_there ? work.results[index] : none_type(), work, place);
    });
  }

  // ---- locals ----

  void annotated_locals(const LocalStat& stat) {
    for (const Comment& comment : stat.comments) {
      const auto annotation = read_annotation(comment);
      if (!annotation || annotation->kind != Annotation::Kind::Type) continue;
      for (size_t i = 0; i < annotation->types.size() && i < stat.locals.size(); ++i) {
        check_name(annotation->types[i]);
        const Local& local = *stat.locals[i];
        for_each_work(*function_, [&](const Work& work) {
          const auto variable = work.variables.find(&local);
          if (variable == work.variables.end()) return false;
          return differs(annotation->types[i], "'" + std::string(local.name) + "'", variable->second.type, work,
                         variable->second.first);
        });
      }
    }
  }

  // ---- both ----

  /// Calls `visitor` for what the function was specialised to, until it gives true.
  template <class Visitor> void for_each_work(const Function& function, Visitor visitor) {
    const auto works = works_.find(&function);
    if (works == works_.end()) return;
    for (const Work* work : works->second)
      if (visitor(*work)) return;
  }

  /// Reports the difference, if there is one.
  bool differs(const AnnotatedType& annotated, std::string what, const Type& type, const Work& work, Span place) {
    if (compare(annotated.text, type) != Verdict::Differs) return false;
    Diagnostic& diagnostic = context_.type_error(work, Code::AnnotationMismatch, annotated.span,
                                                 {std::move(what), std::string(annotated.text), describe(type)});
    if (place.has_place()) diagnostic.note(Code::NoteInferredHere, place, {describe(type)});
    return true;
  }

  /// A name that is probably one of the dialect's types, misspelt.
  void check_name(const AnnotatedType& annotated) {
    const size_t name_end =
        annotated.text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
    if (name_end != std::string_view::npos) return; // no plain name
    if (std::ranges::find(kTypeNames, annotated.text) != std::end(kTypeNames)) return;
    const auto near = nearest(annotated.text, kTypeNames);
    if (!near) return;
    suggest_fix(context_.diagnostics.report(Code::AnnotatedType, annotated.span,
                                            {std::string(annotated.text), suggestion(near)}),
                near);
  }

  Context& context_;
  std::unordered_map<const Function*, std::vector<const Work*>> works_;
  const Function* function_ = nullptr;
};

} // namespace

std::optional<Annotation> read_annotation(const Comment& comment) {
  Scanner scanner(comment);
  if (!scanner.take("---")) return std::nullopt;
  scanner.skip_blanks();
  Annotation annotation{};
  if (scanner.take("@param ")) {
    annotation.kind = Annotation::Kind::Param;
    scanner.skip_blanks();
    const AnnotatedType name = scanner.name();
    annotation.name = name.text;
    annotation.name_span = name.span;
    scanner.take("?");
    scanner.skip_blanks();
    annotation.types.push_back(scanner.type());
    if (annotation.name.empty() || annotation.types[0].text.empty()) return std::nullopt;
    return annotation;
  }
  const bool is_return = scanner.take("@return ");
  if (!is_return && !scanner.take("@type ")) return std::nullopt;
  annotation.kind = is_return ? Annotation::Kind::Return : Annotation::Kind::Type;
  do {
    scanner.skip_blanks();
    const AnnotatedType type = scanner.type();
    if (type.text.empty()) break;
    annotation.types.push_back(type);
    scanner.skip_blanks();
    if (is_return) scanner.name(); // of the result
    scanner.skip_blanks();
  } while (scanner.take(","));
  return annotation;
}

void check_annotations(Context& context) {
  context.specialise_unknown = false; // so that notes name the calls
  Checker(context).check();
}

} // namespace moonshade::sema

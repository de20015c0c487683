// Scenes that say too much, too little or the wrong thing: every error with its line, all at once.

#include "mortise/input/read_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mortise/input/parameter_tree.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

enum class Colour { red, green };

struct Shape : Described {
  double size = 1.0;
  void describe(Parameters& parameters) override { parameters.add("size", size, Says("how large").unit("mm").above(0.0)); }
};
struct Ball : Shape {};
struct Box : Shape {
  int corners = 8;
  void describe(Parameters& parameters) override {
    Shape::describe(parameters);
    parameters.add("corners", corners, Says("how many").at_least(4));
  }
};
const Registry<Shape>& shapes() {
  static const Registry<Shape> registry = Registry<Shape>().add<Ball>("ball", "round").add<Box>("box", "not round");
  return registry;
}

struct Entry {
  Choice<Shape> shape;
  Located<std::string> of;
  void describe(Parameters& parameters) {
    parameters.choose(shape, shapes(), "the shape");
    parameters.add("of", of, "what of");
  }
};

struct Inner {
  bool on = true;
  std::vector<double> weights{1.0, 2.0};
  void describe(Parameters& parameters) {
    parameters.add("on", on, "whether");
    parameters.add("weights", weights, "how heavy");
  }
};

struct Fine {
  std::optional<double> size;
  void describe(Parameters& parameters) { parameters.add("size", size, Says("how fine").above(0.0)); }
};

/// Parameters that bound and replace each other.
struct Bounds {
  int count = 0;
  double low = 0.0, high = 1.0;
  Fine fine, other;
  void describe(Parameters& parameters) {
    parameters.add("count", count, Says("how many").at_least(0));
    parameters.add("low", low, Says("from").at_least(0.0));
    parameters.add("high", high, Says("to").at_least(0.0));
    parameters.list("fine", fine, "how fine");
    parameters.list("other", other, "nothing that anything here is about");
    if (count == 0 && !fine.size) parameters.error("count", "give \"count\", or a \"size\" in \"fine\"");
    if (low > high) parameters.error("high", "is below \"low\"");
  }
};

struct Options {
  double tolerance = 1e-9;
  int count = 3;
  Colour colour = Colour::red;
  ScalarFunction load{0.0};
  std::optional<double> reach;
  std::optional<ScalarFunction> motion;
  ScalarFunction rate{0.0};
  std::vector<std::string> names{"a", "b"};
  Inner inner;
  std::vector<Named<Bounds>> bounds;
  std::vector<Named<Entry>> entries;
  Teuchos::ParameterList solver;
  std::string needed;

  void describe(Parameters& parameters) {
    parameters.add("tolerance", tolerance, Says("how exact").above(0.0).below(1.0));
    parameters.add("count", count, Says("how many").at_least(1));
    parameters.add("colour", colour, {{"red", Colour::red}, {"green", Colour::green}}, "which colour");
    parameters.add("load", load, Says("how strong").unit("N"));
    parameters.add("reach", reach, Says("how far").above(0.0));
    parameters.add("motion", motion, "where to");
    parameters.add("rate", rate, Says("how fast").arguments({"t"}));
    parameters.add("names", names, "who");
    parameters.add("needed", needed, Says("what nobody can guess").required());
    parameters.list("inner", inner, "inside");
    parameters.named("bounds", bounds, "from where to where");
    parameters.named("entries", entries, "things");
    parameters.verbatim("solver", solver, "handed on");
  }
};

struct Read {
  Options options;
  std::string errors;
  Symbols symbols;
};

Read read(const std::string& body, const std::vector<std::string>& overrides = {}) {
  Read result;
  std::vector<Diagnostic> diagnostics;
  try {
    XmlList root = parse_xml("<ParameterList name=\"scene\">\n" + body + "</ParameterList>\n", "scene.xml");
    for (const std::string& one : overrides) apply_override(root, one);
    result.symbols = read_symbols(root, diagnostics);
    read_parameters(result.options, root, result.symbols, {"variables", "tables"}, diagnostics);
  } catch (const InputError& error) {
    diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
  }
  for (const Diagnostic& one : diagnostics) result.errors += to_string(one) + "\n";
  return result;
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}
std::string list(const std::string& name, const std::string& body) { return "<ParameterList name=\"" + name + "\">\n" + body + "</ParameterList>\n"; }
const std::string needed = parameter("needed", "string", "this");

TEST(ReadParameters, FillsEveryKind) {
  const Read result =
      read(list("variables", parameter("n", "int", "4") + parameter("half", "string", "n/8")) +
           list("tables", list("ramp", parameter("times", "string", "0, 1") + parameter("values", "string", "0, 2*n"))) + needed +
           parameter("tolerance", "string", "half/10") + parameter("count", "int", "2*n") + parameter("colour", "string", "green") +
           parameter("load", "string", "ramp(t)*x") + parameter("reach", "double", "1.5") + parameter("motion", "int", "3") +
           parameter("names", "string", "u, v, w") + list("inner", parameter("on", "bool", "false") + parameter("weights", "string", "n, max(1,2)")) +
           list("entries", list("first", parameter("type", "string", "box") + parameter("corners", "int", "6") + parameter("of", "string", "wood"))) +
           list("solver", parameter("max levels", "int", "3") + list("deep", parameter("flag", "bool", "true"))));
  EXPECT_EQ(result.errors, "");
  const Options& options = result.options;
  EXPECT_DOUBLE_EQ(options.tolerance, 0.05);
  EXPECT_EQ(options.count, 8);
  EXPECT_EQ(options.colour, Colour::green);
  EXPECT_DOUBLE_EQ(options.load(0.5, 3.0), 12.0);
  EXPECT_DOUBLE_EQ(options.reach.value(), 1.5);
  EXPECT_DOUBLE_EQ((*options.motion)(), 3.0);
  EXPECT_EQ(options.names, (std::vector<std::string>{"u", "v", "w"}));
  EXPECT_FALSE(options.inner.on);
  EXPECT_EQ(options.inner.weights, (std::vector<double>{4.0, 2.0}));
  ASSERT_EQ(options.entries.size(), 1u);
  EXPECT_EQ(options.entries[0].name, "first");
  EXPECT_EQ(dynamic_cast<const Box&>(*options.entries[0].value.shape.options).corners, 6);
  EXPECT_EQ(options.entries[0].value.of.value, "wood");
  EXPECT_GT(options.entries[0].value.of.place.line, 1);
  EXPECT_EQ(options.solver.get<int>("max levels"), 3);
  EXPECT_TRUE(options.solver.sublist("deep").get<bool>("flag"));
}

// muParser itself would take the last of several values, and assign.
TEST(ReadParameters, TakesOneValueAndAssignsNothing) {
  EXPECT_THAT(read(parameter("load", "string", "0,25")).errors, HasSubstr("\"load\": \"0,25\" holds 2 values separated by commas"));
  EXPECT_THAT(read(parameter("reach", "double", "1,000,000")).errors, HasSubstr("holds 3 values"));
  EXPECT_THAT(read(parameter("load", "string", "t=0.5 ? 1 : 2")).errors,
              HasSubstr("assigns with \"=\", which an expression cannot; \"==\" compares"));
  for (const char* compares : {"t==0.5 ? 1 : 2", "t<=0.5 ? 1 : 2", "t!=0.5 ? 1 : 2", "max(1, 2)"})
    EXPECT_THAT(read(parameter("load", "string", compares)).errors, Not(HasSubstr("load"))) << compares;
}

TEST(ReadParameters, SaysAllErrorsAtOnceWithTheirLines) {
  const std::string errors = read(parameter("tolerence", "double", "1e-3") +                         // 2
                                  parameter("count", "int", "0") +                                   // 3
                                  parameter("colour", "string", "gren") +                            // 4
                                  parameter("load", "string", "2*") +                                // 5
                                  parameter("reach", "double", "5x") +                               // 6
                                  list("inner", parameter("on", "double", "1")) +                    // 7, 8
                                  list("entries", list("one", parameter("type", "string", "bal")) +  // 10, 11, 12
                                                      list("two", parameter("of", "string", "x"))))
                                 .errors;  // 14
  EXPECT_THAT(errors, HasSubstr("scene.xml:2: error: unknown parameter \"tolerence\"; did you mean \"tolerance\"?"));
  EXPECT_THAT(errors, HasSubstr("scene.xml:3: error: \"count\" is 0; allowed: >= 1"));
  EXPECT_THAT(errors, HasSubstr("scene.xml:4: error: \"colour\" is \"gren\"; allowed: \"red\", \"green\"; did you mean \"green\"?"));
  EXPECT_THAT(errors, HasSubstr("scene.xml:5: error: \"load\": cannot evaluate \"2*\""));
  EXPECT_THAT(errors, HasSubstr("scene.xml:6: error: \"reach\": cannot evaluate \"5x\""));
  EXPECT_THAT(errors, HasSubstr("scene.xml:8: error: inner: parameter \"on\" has type \"double\""));
  EXPECT_THAT(errors, HasSubstr("entries/one: \"type\" is \"bal\"; allowed: \"ball\", \"box\"; did you mean \"ball\"?"));
  EXPECT_THAT(errors, HasSubstr("entries/two: \"type\" is missing"));
  EXPECT_THAT(errors, HasSubstr("scene.xml:1: error: \"needed\" is missing; please add it: what nobody can guess"));
}

// A parameter that was refused has its default, of which the scene says nothing.
TEST(ReadParameters, SaysNothingMoreOfWhatItRefused) {
  const auto errors_of = [](const std::string& bounds) { return read(needed + list("bounds", list("one", bounds))).errors; };
  const std::string low = parameter("low", "int", "2"), count = parameter("count", "int", "1");
  EXPECT_EQ(errors_of(parameter("count", "int", "-1")), "scene.xml:5: error: bounds/one: \"count\" is -1; allowed: >= 0\n");
  EXPECT_EQ(errors_of(list("fine", parameter("size", "int", "0"))), "scene.xml:6: error: bounds/one/fine: \"size\" is 0; allowed: > 0\n");
  EXPECT_EQ(errors_of(count + low + parameter("high", "int", "-1")), "scene.xml:7: error: bounds/one: \"high\" is -1; allowed: >= 0\n");
  EXPECT_EQ(errors_of(count + parameter("low", "double", "2x") + parameter("high", "int", "0")).find("is below"), std::string::npos);

  EXPECT_EQ(errors_of(count + low), "scene.xml:4: error: bounds/one: \"high\": is below \"low\"\n");
  EXPECT_THAT(errors_of(low + parameter("count", "int", "-1")), HasSubstr("is below \"low\"")) << "of other parameters it is said";
  EXPECT_THAT(errors_of(list("other", parameter("size", "int", "0"))), HasSubstr("give \"count\"")) << "a list of the same kind, but not that one";
}

TEST(ReadParameters, RefusesWhatIsNoNumber) {
  EXPECT_THAT(read(needed + parameter("tolerance", "double", "0/0")).errors, HasSubstr("not a finite number"));
  EXPECT_THAT(read(needed + parameter("tolerance", "string", "t")).errors, HasSubstr("known names: pi; t, x, y and z have no value here"));
  EXPECT_THAT(read(needed + parameter("count", "int", "1.5")).errors, HasSubstr("whole number"));
  EXPECT_THAT(read(needed + parameter("count", "int", "2147483648")).errors, HasSubstr("whole number"));
  for (const char* wrong : {"1.5", "2147483648", "-1e300"})
    EXPECT_THAT(read(needed + list("solver", parameter("max levels", "int", wrong))).errors, HasSubstr("an int has to be whole, from")) << wrong;
  EXPECT_THAT(read(needed + parameter("tolerance", "double", "unknown")).errors, HasSubstr("known names: pi; t, x"));
  EXPECT_THAT(read(needed + list("tables", list("r", parameter("times", "string", "0, 0") + parameter("values", "string", "1, 2")))).errors,
              HasSubstr("ascend"));
  EXPECT_THAT(read(needed + list("tables", list("r", parameter("times", "string", "0, 1") + parameter("values", "string", "1, sqrt(-1)")))).errors,
              HasSubstr("not a finite number"));
  EXPECT_THAT(read(needed + list("variables", parameter("x", "int", "1"))).errors, HasSubstr("already has a meaning"));
}

// The names are those of the expression, not of any.
TEST(ReadParameters, SaysWhatFormerNamesAreNow) {
  struct {
    double height = 1.0;
    Inner within;
    void describe(Parameters& parameters) {
      parameters.add("height", height, Says("how high").formerly("length"));
      parameters.list("within", within, Says("inside").formerly("content"));
    }
  } options;
  const Symbols symbols;
  std::vector<Diagnostic> diagnostics;
  read_parameters(options, parse_xml(list("scene", parameter("length", "double", "2") + list("content", "") + parameter("on", "bool", "true")), ""),
                  symbols, {}, diagnostics);
  std::vector<std::string> messages;
  for (const Diagnostic& one : diagnostics) messages.push_back(one.message);
  EXPECT_THAT(messages, ::testing::ElementsAre("unknown parameter \"length\"; it is called \"height\" now",
                                               "unknown list \"content\"; it is called \"within\" now",
                                               "unknown parameter \"on\"; known here: \"height\", \"within\""));
}

TEST(ReadParameters, SaysWhichNamesAnExpressionKnows) {
  const std::string variables = list("variables", parameter("n", "int", "4")), unknown = needed + variables;
  const auto expect = [&](const std::string& wrong, const std::string& names) {
    EXPECT_THAT(read(unknown + wrong).errors, HasSubstr("known names: " + names + "\n")) << wrong;
  };
  const std::string none = "pi, n; t, x, y and z have no value here";
  expect(parameter("load", "string", "q"), "t, x, y, z, pi, n");
  expect(parameter("motion", "string", "q"), "t, x, y, z, pi, n");
  expect(parameter("rate", "string", "x"), "t, pi, n");
  expect(parameter("reach", "string", "q"), none);
  expect(list("inner", parameter("weights", "string", "1, x")), none);
  expect(list("solver", parameter("bound", "double", "t")), none);
  expect(list("tables", list("r", parameter("times", "string", "0, t") + parameter("values", "string", "1, 2"))), none);
}

// One thing is wrong, wherever it is used.
TEST(ReadParameters, SaysOnceThatAVariableIsWrong) {
  const std::string uses = parameter("tolerance", "string", "a/1e4") + parameter("load", "string", "a*t + r(t)") +
                           parameter("reach", "string", "2*(a)") + list("inner", parameter("weights", "string", "1, a")) +
                           list("solver", parameter("bound", "double", "-a")) + list("bounds", list("one", parameter("count", "string", "b"))) +
                           needed;
  const std::string b = parameter("b", "string", "2*a"),
                    table = list("tables", list("r", parameter("times", "string", "0, a") + parameter("values", "string", "1, 2")));
  const auto errors_of = [&](const std::string& a) { return read(list("variables", a + b) + table + uses).errors; };
  EXPECT_EQ(errors_of(parameter("a", "string", "1 +")).find('\n'), errors_of(parameter("a", "string", "1 +")).size() - 1);
  EXPECT_THAT(errors_of(parameter("a", "string", "1 +")), HasSubstr("scene.xml:3: error: variables: \"a\": cannot evaluate"));
  EXPECT_EQ(errors_of(parameter("a", "string", "1, 2")), "scene.xml:3: error: variables: variable \"a\" is \"1, 2\"; please give one number\n");
  EXPECT_EQ(errors_of(list("a", "")), "scene.xml:3: error: variables/a: a variable is a parameter, not a list\n");
  // Names that only begin or end alike are others, and so is one that has a meaning of its own.
  const std::string of_others = read(list("variables", parameter("a", "string", "1 +")) + needed + parameter("load", "string", "aa + b_a")).errors;
  EXPECT_THAT(of_others, HasSubstr("scene.xml:6: error: \"load\": cannot evaluate \"aa + b_a\""));
  const std::string reserved = read(list("variables", parameter("x", "int", "1")) + needed + parameter("load", "string", "2*x +")).errors;
  EXPECT_THAT(reserved, HasSubstr("\"x\" already has a meaning"));
  EXPECT_THAT(reserved, HasSubstr("cannot evaluate \"2*x +\""));
}

// Text that a message quotes may be as long as a scene's author pleases.
TEST(ReadParameters, ShortensLongValues) {
  std::string ones = "1";
  while (ones.size() < 10000) ones += "+ 1";
  const std::vector<std::string> wrong{parameter("load", "string", ones + " +"),
                                       parameter("colour", "string", ones),
                                       list("inner", parameter("on", "bool", ones)),
                                       parameter("count", ones, "1"),
                                       list("entries", list("e", parameter("type", "string", ones))),
                                       list("tables", list(ones, "")),
                                       parameter(ones, "int", "1"),
                                       list("bounds", list(ones, parameter("count", "int", "-1")))};
  for (const std::string& one : wrong) {
    const std::string errors = read(needed + one).errors;
    EXPECT_THAT(errors, ::testing::ContainsRegex("1[+ 1]*[.]{3} [(]1000[0-9] characters[)]")) << errors.substr(0, 300);
    EXPECT_LT(errors.size(), 1000u);
  }
  EXPECT_LT(read(needed, {"count=" + ones + "x"}).errors.size(), 1000u);
  EXPECT_EQ(shortened(std::string(120, 'a')), std::string(120, 'a'));
  EXPECT_EQ(shortened(std::string(121, 'a')), std::string(60, 'a') + "... (121 characters)");
  std::string umlauts;
  for (int i = 0; i < 200; ++i) umlauts += "\u00fc";
  EXPECT_EQ(shortened(umlauts), umlauts.substr(0, 120) + "... (200 characters)");
}

TEST(ReadParameters, RefusesBrokenXml) {
  EXPECT_THAT(read("<Parameter name=\"a\"").errors, HasSubstr("scene.xml:2: error: not well-formed XML"));
  EXPECT_THAT(read(needed + needed).errors, HasSubstr("scene.xml:3: error: \"needed\" is given twice"));
  EXPECT_THAT(read("<Parametr name=\"a\"/>\n").errors, HasSubstr("unknown element <Parametr>"));
  EXPECT_THAT(read("<Parameter name=\"a\" typ=\"int\" value=\"1\"/>\n").errors, HasSubstr("unknown attribute \"typ\""));
  EXPECT_THAT(read(parameter("needed", "strng", "1")).errors, HasSubstr("unknown type \"strng\""));
  EXPECT_THAT(read("stray text\n").errors, HasSubstr("text outside of elements"));
  EXPECT_THAT(read("<a></b>\n<c>\n").errors, HasSubstr("scene.xml:2: error: not well-formed XML: Opening and ending tag mismatch"));
}

TEST(ReadParameters, PutsInWhatEntitiesStandFor) {
  const XmlList root = parse_xml(
      R"(<!DOCTYPE ParameterList [<!ENTITY v "23"><!ENTITY w "&v;4"><!ENTITY z "&#48;">]>
<ParameterList name="s&v;"><Parameter name="a&w;b" type="string" value="1&v;&z;"/><Parameter name="c" type="string" value="&v;"/></ParameterList>)",
      "scene.xml");
  EXPECT_EQ(root.name, "s23");
  ASSERT_EQ(root.parameters.size(), 2u);
  EXPECT_EQ(root.parameters[0].name, "a234b");
  EXPECT_EQ(root.parameters[0].value, "1230");
  EXPECT_EQ(root.parameters[1].value, "23");
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      parse_xml(text, "scene.xml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of("<!DOCTYPE l [<!ENTITY e \"<Parameter name='a' type='int' value='1'/>\">]>\n<ParameterList name=\"s\">&e;</ParameterList>"),
              HasSubstr("scene.xml:2: error: the entity \"&e;\" stands in the place of elements"));
  EXPECT_THAT(error_of("<!DOCTYPE l [<!ENTITY e SYSTEM \"/etc/hostname\">]>\n<ParameterList name=\"&e;\"/>"), HasSubstr("external entity"));
}

// The parser's limits keep it from running out of stack and memory.
TEST(ReadParameters, RefusesXmlBeyondAnyScene) {
  std::string begin, end;
  for (int i = 0; i < 100000; ++i) begin += "<ParameterList name=\"a\">", end += "</ParameterList>";
  const std::string limits = "too much: lists may be nested 256 deep, and an attribute may have 10000000 characters\n";
  EXPECT_EQ(read(begin + end).errors, "scene.xml:2: error: " + limits);
  EXPECT_EQ(read("\n" + parameter("needed", "string", std::string(50000000, 'a'))).errors, "scene.xml:3: error: " + limits);
}

TEST(ReadParameters, TakesOverridesFromTheCommandLine) {
  const std::string scene = list("variables", parameter("n", "int", "4")) + needed + parameter("count", "string", "n");
  EXPECT_EQ(read(scene, {"variables/n=7"}).options.count, 7);
  EXPECT_EQ(read(scene, {"inner/weights=1,2,3"}).options.inner.weights.size(), 3u);
  EXPECT_THAT(read(scene, {"inner/wieghts=1"}).errors,
              HasSubstr("command line: --set inner/wieghts=1: error: inner: unknown parameter \"wieghts\"; did you mean \"weights\"?"));
  EXPECT_THAT(read(scene, {"count"}).errors, HasSubstr("\"count\" has no \"=\"; please write path=value"));
  for (const char* nameless : {"=3", "/=3", "/count=3", "variables/=3", "inner//weights=3"})
    EXPECT_THAT(read(scene, {nameless}).errors, HasSubstr("names nothing before, after or between two \"/\"")) << nameless;
}

// A symbol that is not used is mistyped: it would change nothing.
TEST(ReadParameters, RefusesSymbolsThatNothingCouldUse) {
  const std::string n = list("variables", parameter("n", "int", "4"));
  EXPECT_THAT(read(n + needed, {"variables/N=8"}).errors,
              HasSubstr("there is no variable \"N\", and no value uses one; did you mean \"n\"?; the file has \"n\""));
  EXPECT_THAT(read(needed, {"variables/n=8"}).errors, HasSubstr("there is no variable \"n\", and no value uses one; the file has none"));
  EXPECT_EQ(read(needed + parameter("count", "string", "2*m"), {"variables/m=8"}).options.count, 16);
  for (const char* name : {"variables", "tables"})
    EXPECT_THAT(read(n + needed, {std::string(name) + "=3"}).errors, HasSubstr('"' + std::string(name) + "\" is a list, not a parameter"));
  EXPECT_THAT(read(n + needed, {"tables/r=3"}).errors, HasSubstr("table \"r\" is a parameter; a table is a list with \"times\" and \"values\""));
  EXPECT_THAT(read(n + needed, {"tables/n/times=0,1", "tables/n/values=0,1"}).errors, HasSubstr("there is a variable named \"n\" already"));
}

TEST(ReadParameters, SaysWhatIsNoNumber) {
  for (const char* number : {"nan", "inf", "1e400", "0x10"})
    EXPECT_THAT(read(needed + parameter("count", "string", number)).errors, HasSubstr('"' + std::string(number) + "\" is no finite decimal number"));
  const std::string later = list("variables", parameter("a", "string", "2*b") + parameter("b", "int", "1"));
  EXPECT_THAT(read(later + needed).errors, HasSubstr("variable \"a\" is \"2*b\", but it may use only variables that stand above it"));
}

TEST(ReadParameters, TypesOverridesOfWhatIsHandedOnByTheirLook) {
  const std::string scene = needed + list("solver", parameter("max levels", "int", "3"));
  const Read result =
      read(scene, {"solver/max levels=5", "solver/drop tol=1e-8", "solver/deep/flag=false", "solver/deep/scheme=3 by 3", "solver/deep/damping=-.5"});
  EXPECT_EQ(result.errors, "");
  const Teuchos::ParameterList& solver = result.options.solver;
  EXPECT_EQ(solver.get<int>("max levels"), 5);
  EXPECT_EQ(solver.get<double>("drop tol"), 1e-8);
  EXPECT_FALSE(solver.sublist("deep").get<bool>("flag"));
  EXPECT_EQ(solver.sublist("deep").get<std::string>("scheme"), "3 by 3");
  EXPECT_EQ(solver.sublist("deep").get<double>("damping"), -0.5);
}

TEST(ParameterTree, EffectiveSceneReadsBackTheSame) {
  Read first =
      read(list("variables", parameter("n", "int", "4")) + needed + parameter("load", "string", "n*t &lt; 2") + parameter("motion", "string", "t") +
           list("entries", list("one", parameter("type", "string", "ball") + parameter("size", "string", "n/3"))) +
           list("solver", parameter("max levels", "int", "3")));
  ASSERT_EQ(first.errors, "");
  const auto text_of = [](Read& one) {
    return to_scene_xml(collect_parameters("scene", one.options, CollectParameters::What::values), symbol_lists(one.symbols));
  };
  const std::string text = text_of(first);
  Read second;
  std::vector<Diagnostic> diagnostics;
  const XmlList root = parse_xml(text, "effective.xml");
  second.symbols = read_symbols(root, diagnostics);
  read_parameters(second.options, root, second.symbols, {"variables", "tables"}, diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  EXPECT_EQ(text_of(second), text);
  EXPECT_DOUBLE_EQ(second.options.entries[0].value.shape.options->size, 4.0 / 3.0);
}

TEST(ParameterTree, DescribesEverything) {
  Options options;
  const ListRecord tree = collect_parameters("scene", options, CollectParameters::What::declarations);
  for (const std::string& text : {to_text(tree), to_markdown(tree)})
    for (const char* word : {"tolerance", "how exact", "> 0", "red", "what nobody can guess", "corners", "not round", "handed on"})
      EXPECT_THAT(text, HasSubstr(word));
  ASSERT_NE(find_list(tree, "entries/any/box"), nullptr);
  EXPECT_EQ(find_list(tree, "nothing"), nullptr);
}

TEST(Assignments, ArePathsWithTheirLinesWhateverTheyMean) {
  const XmlList root = parse_xml(R"(<ParameterList name="study">
<Parameter name="variables/n" type="int" value="8"/>
<ParameterList name="bodies"><ParameterList name="block">
<Parameter name="element" type="string" value="Q4"/></ParameterList></ParameterList></ParameterList>)",
                                 "study.xml");
  AssignmentList list;
  std::vector<Diagnostic> diagnostics;
  read_parameters(list, root, {}, {}, diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  ASSERT_EQ(list.all.size(), 2u);
  EXPECT_EQ(list.all[0].path + "=" + list.all[0].value, "variables/n=8");
  EXPECT_EQ(list.all[0].place.line, 2);
  EXPECT_EQ(list.all[1].path + "=" + list.all[1].value, "bodies/block/element=Q4");
  EXPECT_EQ(list.all[1].place.line, 4);
}

TEST(Assignments, OverrideAnotherFileAndKeepTheirPlace) {
  XmlList root = parse_xml(
      "<ParameterList name=\"scene\"><ParameterList name=\"a\"><Parameter name=\"x\" type=\"int\" value=\"1\"/>"
      "</ParameterList></ParameterList>",
      "scene.xml");
  apply_override(root, "a/x", "2", {"study.xml", 7, "settings"});
  apply_override(root, "b/c/y", "3", {"study.xml", 8, "settings"});
  EXPECT_EQ(root.list("a")->parameter("x")->value, "2");
  EXPECT_EQ(root.list("a")->parameter("x")->place.line, 7);
  EXPECT_EQ(root.list("a")->parameter("x")->place.file, "study.xml");
  EXPECT_EQ(root.list("b")->list("c")->parameter("y")->value, "3");
  EXPECT_EQ(root.list("b")->list("c")->place.path, "b/c");
}

TEST(Assignments, DoNotGoOnBelowAParameter) {
  XmlList root = parse_xml("<ParameterList name=\"scene\"><Parameter name=\"x\" type=\"int\" value=\"1\"/></ParameterList>", "scene.xml");
  try {
    apply_override(root, "x/y=2");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--set x/y=2"));
    EXPECT_THAT(error.what(), HasSubstr("\"x\" is a parameter: it has a value, and nothing below it"));
  }
}

}  // namespace
}  // namespace mortise

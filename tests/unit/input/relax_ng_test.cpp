// The schema accepts what the reader accepts, and rejects a misspelt name.

#include <gtest/gtest.h>
#include <libxml/relaxng.h>

#include <memory>

#include "mortise/input/parameter_tree.hpp"

namespace mortise {
namespace {

struct Options {
  double tolerance = 1e-9;
  void describe(Parameters& parameters) { parameters.add("tolerance", tolerance, "how exact"); }
};

bool valid(const std::string& schema, const std::string& document) {
  const auto free_context = [](xmlRelaxNGParserCtxt* one) { xmlRelaxNGFreeParserCtxt(one); };
  const std::unique_ptr<xmlRelaxNGParserCtxt, decltype(free_context)> parser(
      xmlRelaxNGNewMemParserCtxt(schema.data(), static_cast<int>(schema.size())), free_context);
  const std::unique_ptr<xmlRelaxNG, void (*)(xmlRelaxNG*)> grammar(xmlRelaxNGParse(parser.get()), xmlRelaxNGFree);
  EXPECT_NE(grammar, nullptr);
  const std::unique_ptr<xmlRelaxNGValidCtxt, void (*)(xmlRelaxNGValidCtxt*)> validator(xmlRelaxNGNewValidCtxt(grammar.get()),
                                                                                       xmlRelaxNGFreeValidCtxt);
  const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> parsed(xmlReadMemory(document.data(), static_cast<int>(document.size()), "scene", nullptr, 0),
                                                          xmlFreeDoc);
  return xmlRelaxNGValidateDoc(validator.get(), parsed.get()) == 0;
}

TEST(RelaxNg, AcceptsScenesAndRejectsMisspeltNames) {
  Options options;
  const std::string schema = to_relax_ng(collect_parameters("scene", options, CollectParameters::What::declarations));
  EXPECT_TRUE(valid(schema, "<ParameterList name=\"s\"><Parameter name=\"tolerance\" type=\"double\" value=\"1\"/></ParameterList>"));
  EXPECT_TRUE(valid(schema,
                    "<ParameterList name=\"s\"><ParameterList name=\"variables\"><Parameter name=\"n\" type=\"int\" "
                    "value=\"1\"/></ParameterList></ParameterList>"));
  EXPECT_FALSE(valid(schema, "<ParameterList name=\"s\"><Parameter name=\"tolerence\" type=\"double\" value=\"1\"/></ParameterList>"));
}

}  // namespace
}  // namespace mortise

#include "pipeline/surface_io/label_names.h"
#include "tests/pipeline/formats/ball_images.h"

namespace palp::test
{
namespace
{

class LabelNames : public Images
{
protected:
  std::filesystem::path table(const std::string& text)
  {
    const std::filesystem::path file = folder_.path() / "names";
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(LabelNames, AreReadAsProgramsWriteThem)
{
  for (const char* text :
    { "# Color table file\n0 Background 0 0 0 0\n1 Liver 221 130 101 255\n"
      "40 portal vein 0 151 206 255\n",
      "# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Background\"\n"
      "    1   255    0    0        1  1  1    \"Liver\"\n"
      "   40   255    0    0        1  1  1    \"portal vein\"\n",
      "LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Category_CodingScheme\n"
      "0,Background,0,0,0,0,SCT\r\n1,Liver,221,130,101,255,SCT\n\n5,,1,2,3\n"
      "40,\"portal vein\",0,151,206,255,SCT\n",
      "Index,TotalSegmentator name,TA2 Latin name\n0,Background,\n1,Liver,hepar\n"
      "40,portal vein,vena portae hepatis\n",
      R"({"0": "Background", "1": "Liver", "40": "portal vein"})",
      R"({"Background": 0, "Liver": 1, "portal vein": 40})",
      R"({"name": "x", "labels": {"Background": 0, "Liver": 1, "portal vein": 40}})" })
  {
    const std::vector<LabelName> names = readLabelNames(table(text));
    ASSERT_EQ(names.size(), 3U) << text;
    EXPECT_EQ(names[2].value, 40.0);
    EXPECT_EQ(valuesOfLabels({ "liver", "PORTAL VEIN", "7", "spleen" }, names),
      (std::vector<std::string>{ "1", "40", "7", "spleen" }))
      << text;
  }
}

TEST_F(LabelNames, ColorsAreThoseOfTheTable)
{
  const std::map<double, std::string> colors{ { 1.0, "#dd8265" }, { 40.0, "#0097ce" } };
  EXPECT_EQ(readLabelColors(table("1 Liver 221 130 101 255\n40 portal vein 0 151 206 255\n"
                                  "7 spleen\n8 segment 4\n")),
    colors);
  EXPECT_EQ(
    readLabelColors(table("1 221 130 101 1 1 1 \"Liver\"\n40 0 151 206 1 0 1 \"vein 2\"\n")),
    colors);
  EXPECT_EQ(readLabelColors(table("LabelValue,Color_G,Color_R,Color_B,Name\n"
                                  "1,130,221,101,Liver\n40,151,0,206,vein\n7,,,,spleen\n")),
    colors);
  EXPECT_TRUE(readLabelColors(table(R"({"1": "Liver"})")).empty());
}

TEST_F(LabelNames, OfLatin1AreRead)
{
  EXPECT_EQ(readLabelNames(table("5 f\xe9mur 0 0 0 0\n"))[0].name, "f\xc3\xa9mur");
  EXPECT_EQ(readLabelNames(table("5 f\xc3\xa9mur 0 0 0 0\n"))[0].name, "f\xc3\xa9mur");
}

// which is no color with three numbers missing
TEST_F(LabelNames, MayEndInANumber)
{
  EXPECT_EQ(readLabelNames(table("5 segment 4\n"))[0].name, "segment 4");
  EXPECT_EQ(readLabelNames(table("5 segment 4 221 130 101 255\n"))[0].name, "segment 4");
}

// a number is a value, whatever is called so
TEST_F(LabelNames, ANameOfTwoValuesIsRefused)
{
  const std::vector<LabelName> names{ { 3.0, "lobe" }, { 7.0, "Lobe" }, { 8.0, "9" } };
  EXPECT_EQ(valuesOfLabels({ "3", "9" }, names), (std::vector<std::string>{ "3", "9" }));
  EXPECT_EQ(valuesOfLabels({ "Lobe", "lobe" }, names), (std::vector<std::string>{ "7", "3" }));
  EXPECT_THROW((void)valuesOfLabels({ "LOBE" }, names), Error);
}

// the words of a command have an end
TEST_F(LabelNames, OfAHugeTableAreRefused)
{
  std::string text;
  for (int i = 1; i < 60'000; ++i)
  {
    text += std::to_string(i) + " region_of_an_atlas_" + std::to_string(i) + " 1 2 3 255\n";
  }
  EXPECT_THROW((void)readLabelNames(table(text)), Error);
  const std::string first = text.substr(0, text.find("\n15001 ") + 1);
  EXPECT_EQ(readLabelNames(table(first)).size(), 15'000U);
}

TEST_F(LabelNames, WhatIsNoTableIsRefusedByItsLine)
{
  for (const auto& [text, what] :
    { std::pair("1 liver 0 0 0 0\nliver 2\n", "names:2: 'liver 2' is no label"),
      { "LabelValue,Name\n1,liver\nx,spleen\n", "names:3: 'x' is no value of a label" },
      { "1 255 0 0\n", "names:1: '1 255 0 0' is no label" },
      { "1 liver 0 0 0 0\n2 lobe\n1 spleen\n", "its value 1 is both 'liver' and 'spleen'" },
      { "8 duct 300 0 0 255\n", "names:1: the color '300 0 0 255' is not red, green and blue" },
      { "8 duct 0.8 0.1 0 1\n", "names:1: the color '0.8 0.1 0 1' is not red, green and blue" },
      { "LabelValue,Color_R,Color_G,Color_B,Name\n7,,,,a\n8,1,x,2,b\n", "names:3: the color" },
      { "{\"1\": [2]}", "'1' is no value with a name" }, { "", "it names no label" },
      { "# of nothing\n", "it names no label" }, { "{}", "it names no label" },
      { "5 liver\x01\n", "no text" }, { "{\"1\": ", "not JSON of values and names" } })
  {
    try
    {
      (void)readLabelNames(table(text));
      ADD_FAILURE() << text;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
}

// told where a label is asked for, and taken by them
TEST_F(LabelNames, AreThoseOfAnImageThatHasNone)
{
  const auto image = ball(true);
  image->GetPointData()->GetScalars()->SetComponent(0, 0, 3.0);
  const auto file = write<vtkMetaImageWriter>("organs.mha", *image);
  const std::vector<LabelName> names{ { 1.0, "liver" }, { 3.0, "spot" } };
  EXPECT_NE(refusal(file, { .names = names }).find("its labels are 1 liver ("), std::string::npos)
    << refusal(file, { .names = names });
  EXPECT_NE(refusal(file, { .names = names }).find(", 3 spot (1 voxel"), std::string::npos);
  const LoadedSurface surface = readSurface(
    file, LengthUnit::Millimeter, { .labels = valuesOfLabels({ "Liver" }, names), .names = names });
  double box[6];
  surface.mesh->GetBounds(box);
  EXPECT_NEAR(0.5 * (box[0] + box[1]), 1e-3 * kCenterMm.x(), 1e-3);
}

} // namespace
} // namespace palp::test

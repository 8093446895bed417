// Shifts are found to the pixel, at exposures that have little in common.
#include "tests/core/bracket/Photos.h"

namespace patina {
namespace {

class Alignment : public test::BracketPhotos {
  protected:
    std::vector<PhotoShift> shiftsOf(const std::vector<PhotoShift>& wanted) {
        std::vector<test::Shot> shots = test::fiveShots("tif");
        shots.resize(wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i)
            shots[i].shift = wanted[i];
        std::vector<PhotoShift> found;
        for (const BracketPhoto& photo : make(writeAll(shots, test::gammaCamera)).report.photos)
            found.push_back(photo.shift);
        return found;
    }
};

TEST_F(Alignment, FindsNoneWhereThereIsNone) {
    const std::vector<PhotoShift> none(5);
    EXPECT_EQ(shiftsOf(none), none);
}

TEST_F(Alignment, FindsShiftsToThePixel) {
    // Against the photo in the middle, whose own is none.
    const std::vector<PhotoShift> far{{-64, 21}, {-17, -33}, {0, 0}, {5, 1}, {48, -60}};
    EXPECT_EQ(shiftsOf(far), far);
    const std::vector<PhotoShift> near{{1, -1}, {0, 0}, {0, 1}, {-2, 3}, {-7, 0}};
    std::vector<PhotoShift> fromMiddle;
    for (const PhotoShift& shift : near)
        fromMiddle.push_back({shift.dx, shift.dy - 1});
    EXPECT_EQ(shiftsOf(near), fromMiddle);
}

TEST_F(Alignment, IsLeftOutOnRequest) {
    std::vector<test::Shot> shots = test::fiveShots("tif");
    shots[4].shift = {9, 4};
    const auto files = writeAll(shots, test::gammaCamera);
    BracketOptions options;
    options.align = false;
    const Bracket crooked = make(files, options);
    const Bracket straight = make(files);
    EXPECT_EQ(crooked.report.photos[4].shift, PhotoShift());
    // What is left of a misalignment shows as disagreement.
    EXPECT_GT(crooked.report.disagreeing, 0.05);
    EXPECT_LT(straight.report.disagreeing, 0.001);
}

TEST_F(Alignment, OfUniformPicturesIsNone) {
    std::vector<Photo> photos(2);
    for (Photo& photo : photos)
        photo.image = Image(64, 64, 3, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(findShifts(photos), std::vector<PhotoShift>(2));
}

} // namespace
} // namespace patina

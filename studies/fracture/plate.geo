// A plate with a straight notch from its left side, in the middle of its height or elsewhere: width x height, lower left corner at
// the origin, notch from (0, at) to (length, at). Elements of edge `size` all over.
DefineConstant[ width = 0.1, height = 0.04, at = 0.02, length = 0.05, size = 0.002, algorithm = 5 ];
// 5: Delaunay, irregular; the default one makes lattices of equal triangles, along which cracks like to run.
Mesh.Algorithm = algorithm;
Point(1) = {0, 0, 0, size};
Point(2) = {width, 0, 0, size};
Point(3) = {width, height, 0, size};
Point(4) = {0, height, 0, size};
Point(5) = {0, at, 0, size};
Point(6) = {length, at, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Line(6) = {5, 6};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Curve{6} In Surface{1};
Physical Surface("plate") = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left_above") = {4};
Physical Curve("left_below") = {5};
Physical Curve("notch") = {6};

// The unit square for the reference solution of the spread load: fine where the solution is singular, at the ends of
// the supports, of the load, and at the corner where the two loaded edges meet.
DefineConstant[ h = 0.03, fine = 1e-5 ];
Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, fine};
Point(3) = {1, 0.75, 0, fine};
Point(4) = {1, 1, 0, fine};
Point(5) = {0.75, 1, 0, fine};
Point(6) = {0, 1, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
// From point to point sizes grow in proportion to the distance, by a fifth of it.
Field[1] = Distance;
Field[1].PointsList = {2, 3, 4, 5, 6};
Field[2] = MathEval;
Field[2].F = Sprintf("Min(%g, %g + 0.2*F1)", h, fine);
Background Field = 2;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Physical Surface("solid") = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2, 3};
Physical Curve("top") = {4, 5};
Physical Curve("left") = {6};
Physical Curve("outer") = {1:6};
Physical Point("top_right") = {4};

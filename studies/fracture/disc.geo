// A disc about the origin; aligned = 1: sides of elements run along the loaded diameter. Loaded arcs of 2 alpha at top and bottom; points where the axes meet the rim.
DefineConstant[ R = 0.025, size = 0.0025, alpha = 0.1, aligned = 1 ];
Point(1) = {0, 0, 0, size};
Point(2) = {R, 0, 0, size};
Point(3) = {R*Sin(alpha), R*Cos(alpha), 0, size};
Point(4) = {0, R, 0, size};
Point(5) = {-R*Sin(alpha), R*Cos(alpha), 0, size};
Point(6) = {-R, 0, 0, size};
Point(7) = {-R*Sin(alpha), -R*Cos(alpha), 0, size};
Point(8) = {0, -R, 0, size};
Point(9) = {R*Sin(alpha), -R*Cos(alpha), 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 8};
Circle(7) = {8, 1, 9};
Circle(8) = {9, 1, 2};
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};
If(aligned > 0)
    Line(9) = {4, 1};
    Line(10) = {1, 8};
    Curve{9, 10} In Surface{1};
EndIf
Physical Surface("disc") = {1};
Physical Curve("top") = {2, 3};
Physical Curve("bottom") = {6, 7};
Physical Point("left_point") = {6};
Physical Point("right_point") = {2};
Physical Point("top_point") = {4};

// One composite triangle: the program's bound of its frequencies is that of its own matrices.
Point(1) = {0, 0, 0, 10};
Point(2) = {1, 0.1, 0, 10};
Point(3) = {0.3, 0.9, 0, 10};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1:3};
Plane Surface(1) = {1};
Transfinite Curve{1:3} = 2;
Transfinite Surface{1};
Physical Surface("solid") = {1};
Physical Curve("outer") = {1:3};

// Four curved layers under a free surface and a cavity in the second one, as Figures 22 and 23a of Lei et al. (2016); assumptions
// in README.md. Interface k runs from left to right at depth_k + rise_k bump(x) below the surface y = 0.
DefineConstant[ width = 120, depth = 80, cavity_x = 0, cavity_y = -20, radius = 2.5, size = 1.1, fine = 0.4, n = 16,
                turn = 0, algorithm = 6, depth_1 = -14, depth_2 = -34, depth_3 = -56, rise_1 = 5, rise_2 = 8, rise_3 = 6 ];
// sides of composites: `size` far away, `fine` at the cavity. Another mesh: another angle (rad) of the first point on the
// cavity, another of Gmsh's algorithms (5 Delaunay, 6 frontal).
Mesh.Algorithm = algorithm;
depths() = {depth_1, depth_2, depth_3};
rises() = {rise_1, rise_2, rise_3};
Point(1) = {-width/2, -depth, 0, size};
Point(2) = {width/2, -depth, 0, size};
Point(3) = {width/2, 0, 0, size};
Point(4) = {-width/2, 0, 0, size};
For k In {0:2}
    // an anticline left of the middle that runs out into a syncline: the same in cases.py
    For i In {0:n}
        x = -width/2 + width*i/n;
        Point(100*(k + 1) + i) = {x, depths(k) + rises(k)*Sin(2*Pi*(x/width + 0.375)), 0, size};
    EndFor
    Spline(10 + k) = {100*(k + 1):100*(k + 1) + n};
EndFor
Line(1) = {1, 2};
Line(2) = {2, 300 + n};
Line(3) = {300 + n, 200 + n};
Line(4) = {200 + n, 100 + n};
Line(5) = {100 + n, 3};
Line(6) = {3, 4};
Line(7) = {4, 100};
Line(8) = {100, 200};
Line(9) = {200, 300};
Line(20) = {300, 1};
Point(50) = {cavity_x, cavity_y, 0, fine};
For k In {0:3}
    Point(51 + k) = {cavity_x + radius*Cos(turn + k*Pi/2), cavity_y + radius*Sin(turn + k*Pi/2), 0, fine};
EndFor
Circle(31) = {51, 50, 52};
Circle(32) = {52, 50, 53};
Circle(33) = {53, 50, 54};
Circle(34) = {54, 50, 51};
Curve Loop(1) = {5, 6, 7, 10};
Curve Loop(2) = {4, -10, 8, 11};
Curve Loop(3) = {3, -11, 9, 12};
Curve Loop(4) = {2, -12, 20, 1};
Curve Loop(5) = {31, 32, 33, 34};
Plane Surface(1) = {1};
Plane Surface(2) = {2, 5};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Physical Surface("layer_1") = {1};
Physical Surface("layer_2") = {2};
Physical Surface("layer_3") = {3};
Physical Surface("layer_4") = {4};
Physical Curve("ground") = {6};
Physical Curve("outer") = {1, 2, 3, 4, 5, 7, 8, 9, 20};
Physical Curve("cavity") = {31, 32, 33, 34};
Physical Curve("interface_12") = {10};
Physical Curve("interface_23") = {11};
Physical Curve("interface_34") = {12};

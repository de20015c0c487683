// A curved spring washer between two plates; the quarter. Lengths in mm.
//   gmsh -3 wave_washer.geo -o wave_washer.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 1.8 ];
Mesh.MeshSizeMin = h/3; Mesh.MeshSizeMax = h;
s = 1.5; B = 120;                  // thickness, radius of its bend
r = 7; R = 14;
// a piece of a bent sheet, from which the ring is cut
Cylinder(1) = {0,-1,-B, 0,20,0, B};
Cylinder(2) = {0,-2,-B, 0,22,0, B-s};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,-20, 0,0,40, R, Pi/2};
Cylinder(5) = {0,0,-21, 0,0,42, r, Pi/2};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
BooleanIntersection(7) = { Volume{3}; Delete; }{ Volume{6}; Delete; };
// its crown is at z = 0; its lowest edge at x = R stands on the lower plate
z0 = -B + Sqrt((B-s)^2 - R^2);
Box(11) = {0,0,0, 17,17,2};
Box(12) = {0,0,z0-2, 17,17,2};
Physical Volume("washer") = {7};
Physical Volume("upper plate") = {11};
Physical Volume("lower plate") = {12};
e = 0.01;
Physical Surface("top") = Surface In BoundingBox {-e,-e,2-e, 18,18,2+e};
Physical Surface("floor") = Surface In BoundingBox {-e,-e,z0-2-e, 18,18,z0-2+e};
Physical Surface("plane x") = Surface In BoundingBox {-e,-e,-20, e,18,10};
Physical Surface("plane y") = Surface In BoundingBox {-e,-e,-20, 18,e,10};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("back of the washer") = {2};
Physical Surface("hollow of the washer") = {6};
Physical Surface("under the upper plate") = {11};
Physical Surface("on the lower plate") = {18};

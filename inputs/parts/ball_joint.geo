// A ball of steel in a socket of plastic that is too small by i, a half: y = 0 is the plane of symmetry. Lengths in mm.
//   gmsh -3 ball_joint.geo -o ball_joint.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 3 ];
DefineConstant[ i = 0.04 ];
Mesh.MeshSizeMin = h/3; Mesh.MeshSizeMax = 1.6*h;
Mesh.MeshSizeFromCurvature = 2*Pi*10/h;
// the ball with its stud along z
Sphere(1) = {0,0,0, 10};
Cylinder(2) = {0,0,0, 0,0,22, 5};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-30,0,-30, 60,30,60};
BooleanIntersection(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
// the socket, which holds the ball up to z = 4
Cylinder(11) = {0,0,-14, 0,0,18, 15};
Sphere(12) = {0,0,0, 10-i};
BooleanDifference(13) = { Volume{11}; Delete; }{ Volume{12}; Delete; };
Box(14) = {-30,0,-30, 60,30,60};
BooleanIntersection(15) = { Volume{13}; Delete; }{ Volume{14}; Delete; };
Physical Volume("ball") = {5};
Physical Volume("socket") = {15};
e = 0.01;
Physical Surface("end of the stud") = Surface In BoundingBox {-6,-e,22-e, 6,6,22+e};
Physical Surface("floor") = Surface In BoundingBox {-16,-e,-14-e, 16,16,-14+e};
Physical Surface("plane y") = Surface In BoundingBox {-16,-e,-15, 16,e,23};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("sphere") = {1};
Physical Surface("hollow") = {9};

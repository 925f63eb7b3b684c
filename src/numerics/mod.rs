//! Exact signs of determinants of points with f64 coordinates, circumcentres with rigorous error
//! bounds, and lengths that neither overflow nor underflow. Knows no mesh.
